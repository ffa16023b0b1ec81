#pragma once

#include <array>
#include <vector>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/plugin/observer.hpp"

namespace mesogen {

/// Coordinates of all particles in the box, m, in the order of storage, as are ObserverContext::values: for what does
/// not depend on which particle is which, such as a search.
template <int Dim>
[[nodiscard]] std::vector<std::array<double, Dim>> stored_positions(const ObserverContext& context) {
  std::vector<std::array<double, Dim>> points(context.id().size());
  const auto count = static_cast<Index>(points.size());
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto along = context.position(static_cast<int>(d));
#pragma omp parallel for schedule(static) if (count >= exec::parallel_from)
    for (Index i = 0; i < count; ++i) points[static_cast<std::size_t>(i)][d] = along[static_cast<std::size_t>(i)];
  }
  return points;
}

}  // namespace mesogen
