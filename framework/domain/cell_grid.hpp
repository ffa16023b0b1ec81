#pragma once

#include <array>

#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// The cells of a box: narrow along x, half as high as the search range across it, with padding beyond faces that do
/// not wrap. See Neighbours for what they are good for.
class MESOGEN_EXPORT CellGrid {
 public:
  /// `range`: how far a neighbour may be when it is looked for, m.
  CellGrid(const Scene& scene, const Boundary& boundary, double range);

  static constexpr int cells_in_tile = 64;

  using Cell = std::array<int, 3>;

  /// Cell along one axis, not bounded by the box.
  [[nodiscard]] int along(int axis, double position) const;
  /// Number of the cell inside the box that holds a position in it.
  [[nodiscard]] int number_of(const std::array<double, 3>& position) const;
  /// Coordinates of the n-th cell inside the box.
  [[nodiscard]] Cell inside(int number) const;
  /// Cell in the padding (or beside it, inside, along axes without offset) of a copy of a particle.
  [[nodiscard]] Cell of_copy(const std::array<double, 3>& source, const std::array<double, 3>& offset) const;
  /// Cell in the padding of a dummy. Throws Error(plugin_refused) if it lies beyond no face but those where the box
  /// wraps: cells inside know particles only.
  [[nodiscard]] Cell of_dummy(const std::array<double, 3>& position) const;
  /// Cell inside the box nearest to a position.
  [[nodiscard]] Cell nearest_inside(const std::array<double, 3>& position) const;
  /// Index of a cell among all, the padding included.
  [[nodiscard]] int padded_index(const Cell& cell) const;
  [[nodiscard]] int inside_count() const;
  [[nodiscard]] int padded_count() const;
  /// Where the tile of a cell begins along an axis, m.
  [[nodiscard]] double tile_origin(int axis, int cell) const;

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int cells(int axis) const { return cells_[axis]; }
  [[nodiscard]] int padding(int axis) const { return padding_[axis]; }
  [[nodiscard]] int reach(int axis) const { return reach_[axis]; }
  [[nodiscard]] bool wrapped(int axis) const { return wrapped_[axis]; }
  [[nodiscard]] double width(int axis) const { return width_[axis]; }

 private:
  int dimension_;
  std::array<double, 3> box_{};
  std::array<int, 3> cells_{1, 1, 1};
  std::array<int, 3> padding_{};
  std::array<int, 3> reach_{};
  std::array<bool, 3> wrapped_{};
  std::array<double, 3> width_{};
};

}  // namespace mesogen
