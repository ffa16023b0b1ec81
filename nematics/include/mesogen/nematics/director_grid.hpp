#pragma once

#include <array>
#include <vector>

#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen::nematics {

/// A point where the director is singular.
struct Defect {
  std::array<double, 2> position{};  ///< m, in the box
  double charge = 0.0;               ///< +1/2 or -1/2
  double orientation = 0.0;          ///< rad; see DirectorGrid::orientation
};

/// (Q11, Q12).
using OrderTensor = std::array<double, 2>;

/// The order tensor on a regular grid, and the defects of its director.
///
/// The number of nodes along each axis is that of the particle spacings that fit. Between walls the first and last node
/// are half a spacing off the walls, and no plaquette reaches across them. No plaquette lies in a solid. The value at a
/// node is the mean of the particles around it, weighted by a kernel; see mesh::node_means.
class DirectorGrid {
 public:
  /// Uses the field `order_tensor` that an observer sees. The weights are the run's kernel with this smoothing length,
  /// in particle spacings.
  DirectorGrid(const ObserverContext& context, double smoothing_length);

  /// Returns one defect for each plaquette (square of four nodes) around which the director turns by half a turn. The
  /// turn along an edge is taken the short way. The two plaquettes beside an edge count the same number with opposite
  /// signs, so the charges of a periodic box sum to exactly 0 for any data.
  [[nodiscard]] std::vector<Defect> defects() const;

 private:
  [[nodiscard]] std::size_t node(int i, int j) const;
  [[nodiscard]] std::vector<char> nodes_in_solids(const Scene& scene) const;
  [[nodiscard]] std::vector<Defect> defects_of_row(int j) const;
  /// Returns the point (s, t) in plaquette (i, j), each in [0, 1], where the bilinear interpolation of Q is zero.
  [[nodiscard]] std::array<double, 2> zero(int i, int j) const;
  /// The direction, seen from the defect, in which the director is radial. With k = +-1/2 the charge, it is
  ///
  ///     k / (1 - k) * atan2( <sgn(k) d_x Q12 - d_y Q11> , <d_x Q11 + sgn(k) d_y Q12> )
  ///
  /// (Vromans & Giomi, Soft Matter 12, 6490, 2016). The gradients are means over the 3 x 3 plaquettes around the
  /// defect. For +1/2 it is the direction of div Q, from the head of the comet to its tail, in (-pi, pi]; an extensile
  /// defect moves in the opposite direction. For -1/2 it is one of the three legs, in [-pi/3, pi/3].
  [[nodiscard]] double orientation(int i, int j, double charge) const;

  std::array<int, 2> nodes_{};
  std::array<int, 2> plaquettes_{};
  std::array<double, 2> width_{};  // distance of nodes, m
  std::array<double, 2> first_{};  // coordinates of the first node, m
  std::vector<OrderTensor> tensor_;
};

/// The defects without pairs of opposite charges closer than `distance`, m, closest pairs first; same total charge.
std::vector<Defect> without_close_pairs(const std::vector<Defect>& defects, const Scene& scene, double distance);

/// Returns the smallest distance between defects of opposite charges, m, across periodic faces too. NaN if there is no
/// such pair.
double pair_distance(const std::vector<Defect>& defects, const Scene& scene);

}  // namespace mesogen::nematics
