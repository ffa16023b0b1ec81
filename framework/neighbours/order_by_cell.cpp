#include "neighbours/order_by_cell.hpp"

#include <omp.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mesogen::exec {

// A counting sort in which a few threads count and then place a part of the particles each; who comes first within a
// cell is settled at the end, so the parts leave no trace. More parts would take longer to put together than they save.
void order_by_cell(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) {
  constexpr int most_parts = 4;
  const int parts = std::min(most_parts, omp_get_max_threads());
  const auto number = static_cast<std::size_t>(cells);
  std::vector<Index> begin(number + 1);
  // By part and cell: first how many there are, then where the next one goes.
  std::vector<Index> next(number * static_cast<std::size_t>(parts), 0);
#pragma omp parallel num_threads(parts)
  {
    Index* const own = next.data() + number * static_cast<std::size_t>(omp_get_thread_num());
#pragma omp for schedule(static)
    for (Index i = 0; i < count; ++i) ++own[cell[i]];
#pragma omp single
    {
      Index placed = 0;
      for (std::size_t c = 0; c < number; ++c) {
        begin[c] = placed;
        for (std::size_t at = c; at < next.size(); at += number) placed += std::exchange(next[at], placed);
      }
      begin.back() = placed;
    }
#pragma omp for schedule(static)
    for (Index i = 0; i < count; ++i) order[own[cell[i]]++] = i;
  }
#pragma omp parallel for schedule(static)
  for (int c = 0; c < cells; ++c)
    std::sort(order + begin[static_cast<std::size_t>(c)], order + begin[static_cast<std::size_t>(c) + 1],
              [&](Index a, Index b) { return id[a] < id[b]; });
}

}  // namespace mesogen::exec
