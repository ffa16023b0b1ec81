#include "contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/mesh/particle_mesh.hpp"

namespace mesogen {

namespace {

constexpr double level = 0.5;

/// Corners of a square in the order of a walk around it.
constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// Length of the line in a square of the given edges, by the values at its corners.
double length_in_square(const std::array<double, 4>& value, const std::array<double, 2>& edge) {
  std::array<std::array<double, 2>, 4> crossing{};  // where the line enters or leaves, m from the first corner
  std::size_t crossings = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if ((value[k] >= level) == (value[next] >= level)) continue;
    const double part = (level - value[k]) / (value[next] - value[k]);
    for (std::size_t d = 0; d < 2; ++d)
      crossing[crossings][d] = edge[d] * (corners[k][d] + part * (corners[next][d] - corners[k][d]));
    ++crossings;
  }
  const auto piece = [&](std::size_t a, std::size_t b) {
    return std::hypot(crossing[a][0] - crossing[b][0], crossing[a][1] - crossing[b][1]);
  };
  if (crossings == 0) return 0.0;
  if (crossings == 2) return piece(0, 1);
  // Two corners of a diagonal are cut off: those unlike the middle.
  const bool middle = value[0] + value[1] + value[2] + value[3] >= 4.0 * level;
  return middle == (value[0] >= level) ? piece(0, 1) + piece(2, 3) : piece(3, 0) + piece(1, 2);
}

/// The colour on a regular grid, NaN at nodes without particles about.
class ColourGrid {
 public:
  ColourGrid(const Scene& scene, const std::vector<std::array<double, 2>>& points, const std::vector<double>& colour,
             double mesh_spacing) {
    constexpr int reach = mesh::CubicSpline::points;
    for (std::size_t d = 0; d < 2; ++d) {
      squares_[d] = std::max(reach, static_cast<int>(std::lround(scene.box[d] / (mesh_spacing * scene.spacing))));
      width_[d] = scene.box[d] / squares_[d];
      // The mesh is periodic. Between walls it goes on beyond the box, as far as particles at one wall reach, and so
      // they do not touch the nodes at the other.
      grid_.points[d] = squares_[d] + (scene.periodic[d] ? 0 : reach);
      grid_.length[d] = grid_.points[d] * width_[d];
    }
    spread(points, colour);
  }

  /// Length of the line, m.
  [[nodiscard]] double length() const {
    exec::CompensatedSum sum;
    for (int j = 0; j < squares_[1]; ++j) {
      for (int i = 0; i < squares_[0]; ++i) {
        std::array<double, 4> value{};
        bool known = true;
        for (std::size_t k = 0; k < 4; ++k) {
          value[k] = at(i + corners[k][0], j + corners[k][1]);
          known = known && !std::isnan(value[k]);
        }
        if (known) sum.add(length_in_square(value, width_));
      }
    }
    return sum.value();
  }

 private:
  void spread(const std::vector<std::array<double, 2>>& points, const std::vector<double>& colour) {
    std::array<std::vector<double>, 2> position;
    for (const auto& point : points)
      for (std::size_t d = 0; d < 2; ++d) position[d].push_back(point[d]);
    mesh::ParticleMesh<2> mesh(grid_);
    mesh.locate({position[0].data(), position[1].data()}, static_cast<Index>(points.size()));
    mesh::FieldsOnGrid<double> sums(grid_, 2);  // of weights, and of weights times colour
    mesh.spread<2>(
        [&](Index i, double* numbers) {
          numbers[0] = 1.0;
          numbers[1] = colour[static_cast<std::size_t>(i)];
        },
        sums);
    for (int j = 0; j < grid_.points[1]; ++j) {
      for (int i = 0; i < grid_.points[0]; ++i) {
        const double weight = sums.row(0, j)[i];
        value_.push_back(weight > 0.0 ? sums.row(1, j)[i] / weight : std::numeric_limits<double>::quiet_NaN());
      }
    }
  }

  [[nodiscard]] double at(int i, int j) const {
    const auto row = static_cast<std::size_t>(j % grid_.points[1]);
    const auto columns = static_cast<std::size_t>(grid_.points[0]);
    return value_[row * columns + static_cast<std::size_t>(i) % columns];
  }

  std::array<int, 2> squares_{};   // along each axis
  std::array<double, 2> width_{};  // of one, m
  mesh::Grid<2> grid_;
  std::vector<double> value_;  // at the points of the mesh, the first axis fastest
};

}  // namespace

double contour_length(const Scene& scene, const std::vector<std::array<double, 2>>& points,
                      const std::vector<double>& colour, double mesh_spacing) {
  return ColourGrid(scene, points, colour, mesh_spacing).length();
}

}  // namespace mesogen
