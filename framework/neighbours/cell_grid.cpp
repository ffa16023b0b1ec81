#include "neighbours/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace mesogen {

namespace {

// Parts of the range that a cell is long and high: small ones make runs of neighbours that hold little else, large ones
// fewer runs. Measured: docs/performance.md.
constexpr int narrow = 4;
constexpr int low = 2;

}  // namespace

CellGrid::CellGrid(const Scene& scene, const Boundary& boundary, double range) : dimension_(scene.dimension) {
  for (int d = 0; d < dimension_; ++d) {
    const double wanted = range / (d == 0 ? narrow : low);
    cells_[d] = std::max(1, static_cast<int>(std::floor(scene.box[d] / wanted)));
    width_[d] = scene.box[d] / cells_[d];
    reach_[d] = static_cast<int>(std::ceil(range / width_[d] * (1.0 - 1e-12)));
    wrapped_[d] = boundary.continuation(d) == Continuation::wrapped;
    padding_[d] = wrapped_[d] ? 0 : reach_[d];
  }
}

CellGrid::Cell CellGrid::nearest_inside(const std::array<double, 3>& position) const {
  Cell cell{};
  for (int d = 0; d < dimension_; ++d) cell[d] = std::clamp(along(d, position[d]), 0, cells_[d] - 1);
  return cell;
}

}  // namespace mesogen
