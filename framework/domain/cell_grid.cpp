#include "domain/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

// Parts of the range that a cell is long and high: small ones make runs of neighbours that hold little else, large ones
// fewer runs. Measured: docs/performance.md.
constexpr int narrow = 4;
constexpr int low = 2;

}  // namespace

CellGrid::CellGrid(const Scene& scene, const Boundary& boundary, double range)
    : dimension_(scene.dimension), box_(scene.box) {
  for (int d = 0; d < dimension_; ++d) {
    const double wanted = range / (d == 0 ? narrow : low);
    cells_[d] = std::max(1, static_cast<int>(std::floor(scene.box[d] / wanted)));
    width_[d] = scene.box[d] / cells_[d];
    reach_[d] = static_cast<int>(std::ceil(range / width_[d] * (1.0 - 1e-12)));
    wrapped_[d] = boundary.wraps(d);
    padding_[d] = wrapped_[d] ? 0 : reach_[d];
  }
}

CellGrid::Cell CellGrid::of_copy(const std::array<double, 3>& source, const std::array<double, 3>& offset) const {
  Cell cell{};
  for (int d = 0; d < dimension_; ++d) {
    cell[d] = std::clamp(along(d, source[d] + offset[d]), -padding_[d], cells_[d] + padding_[d] - 1);
    // Rounding must not move a copy over a face: the cells inside the box know only particles.
    if (offset[d] < 0.0) cell[d] = std::min(cell[d], -1);
    if (offset[d] > 0.0) cell[d] = std::max(cell[d], cells_[d]);
    if (offset[d] == 0.0) cell[d] = std::clamp(cell[d], 0, cells_[d] - 1);
  }
  return cell;
}

CellGrid::Cell CellGrid::of_dummy(const std::array<double, 3>& position) const {
  Cell cell = nearest_inside(position);
  bool outside = false;
  for (int d = 0; d < dimension_; ++d) {
    if (wrapped_[d]) continue;
    // A face belongs to the outside, whatever rounding makes of the cell.
    if (position[d] <= 0.0) cell[d] = std::clamp(along(d, position[d]), -padding_[d], -1);
    if (position[d] >= box_[d]) cell[d] = std::clamp(along(d, position[d]), cells_[d], cells_[d] + padding_[d] - 1);
    outside = outside || cell[d] < 0 || cell[d] >= cells_[d];
  }
  if (!outside) {
    std::string at;
    for (int d = 0; d < dimension_; ++d) at += (d > 0 ? ", " : "") + std::to_string(position[d]);
    throw Error(ExitCode::plugin_refused,
                "the boundary puts a dummy at (" + at + "), beyond a face where the box wraps: nobody would see it");
  }
  return cell;
}

CellGrid::Cell CellGrid::nearest_inside(const std::array<double, 3>& position) const {
  Cell cell{};
  for (int d = 0; d < dimension_; ++d) cell[d] = std::clamp(along(d, position[d]), 0, cells_[d] - 1);
  return cell;
}

int CellGrid::padded_count() const {
  int count = 1;
  for (int d = 0; d < dimension_; ++d) count *= cells_[d] + 2 * padding_[d];
  return count;
}

}  // namespace mesogen
