#include "solids/clear_cells.hpp"

#include <algorithm>
#include <cmath>

#include "mesogen/exec/first_failure.hpp"

namespace mesogen {

namespace {

constexpr double wanted_width = 2.0;  // in spacings

}  // namespace

ClearCells::ClearCells(const FluidRegion& region, const Scene& scene) : dimension_(scene.dimension) {
  std::size_t count = 1;
  double diagonal = 0.0;
  for (int d = 0; d < dimension_; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    cells_[axis] =
        static_cast<std::size_t>(std::max(1.0, std::floor(scene.box[axis] / (wanted_width * scene.spacing))));
    width_[axis] = scene.box[axis] / static_cast<double>(cells_[axis]);
    diagonal = std::hypot(diagonal, width_[axis]);
    count *= cells_[axis];
  }
  clear_.resize(count);
  exec::FirstFailure failure;
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < count; ++n) {
    Shape::Point centre{};
    for (std::size_t d = 0, rest = n; d < 3; rest /= cells_[d], ++d)
      centre[d] = (static_cast<double>(rest % cells_[d]) + 0.5) * width_[d];
    try {
      clear_[n] = region.distance(centre) > 0.51 * diagonal ? 1 : 0;
    } catch (...) {
      failure.keep();
    }
  }
  failure.rethrow();
}

}  // namespace mesogen
