#include "exec/order_by_cell.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mesogen::exec {

void order_by_cell(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) {
  std::vector<Index> begin(static_cast<std::size_t>(cells) + 1, 0);
  for (Index i = 0; i < count; ++i) ++begin[static_cast<std::size_t>(cell[i]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for (Index i = 0; i < count; ++i) order[next[static_cast<std::size_t>(cell[i])]++] = i;
#pragma omp parallel for schedule(static)
  for (int c = 0; c < cells; ++c)
    std::sort(order + begin[static_cast<std::size_t>(c)], order + begin[static_cast<std::size_t>(c) + 1],
              [&](Index a, Index b) { return id[a] < id[b]; });
}

Index find_outside(const double* const* position, const double* box, int dimension, Index count, Index* found) {
  Index number = 0;
  for (Index i = 0; i < count; ++i) {
    bool inside = true;
    for (int d = 0; d < dimension; ++d) inside = inside && position[d][i] >= 0.0 && position[d][i] < box[d];
    if (!inside) found[number++] = i;
  }
  return number;
}

}  // namespace mesogen::exec
