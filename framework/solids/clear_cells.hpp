#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "solids/fluid_region.hpp"

namespace mesogen {

/// Cells of the box that hold fluid alone: there nobody needs to ask how far the solids are.
class MESOGEN_EXPORT ClearCells {
 public:
  ClearCells(const FluidRegion& region, const Scene& scene);

  /// Is the point, which is in the box, in such a cell?
  [[nodiscard]] bool hold(const double* at) const {
    std::size_t cell = 0;
    for (int d = dimension_ - 1; d >= 0; --d) {
      const auto axis = static_cast<std::size_t>(d);
      const auto along = static_cast<std::size_t>(at[d] / width_[axis]);
      cell = cell * cells_[axis] + (along < cells_[axis] ? along : cells_[axis] - 1);
    }
    return clear_[cell] != 0;
  }

 private:
  int dimension_;
  std::array<std::size_t, 3> cells_{1, 1, 1};
  std::array<double, 3> width_{};
  std::vector<char> clear_;
};

}  // namespace mesogen
