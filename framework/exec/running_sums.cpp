#include "exec/running_sums.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace mesogen::exec {

// Chunk by chunk: what each adds up to, what lies before each, and then the sums within each.
Index running_sums(Index* values, Index count) {
  constexpr Index size = 4096;
  const Index chunks = (count + size - 1) / size;
  const auto range = [&](Index chunk) {
    const std::ptrdiff_t first = std::ptrdiff_t{chunk} * size;
    return std::pair(values + first, values + std::min<std::ptrdiff_t>(count, first + size));
  };
  std::vector<Index> before(static_cast<std::size_t>(chunks));
#pragma omp parallel for schedule(static)
  for (Index chunk = 0; chunk < chunks; ++chunk) {
    const auto [begin, end] = range(chunk);
    before[static_cast<std::size_t>(chunk)] = std::accumulate(begin, end, Index(0));
  }
  const Index all = std::accumulate(before.begin(), before.end(), Index(0));
  std::exclusive_scan(before.begin(), before.end(), before.begin(), Index(0));
#pragma omp parallel for schedule(static)
  for (Index chunk = 0; chunk < chunks; ++chunk) {
    const auto [begin, end] = range(chunk);
    std::exclusive_scan(begin, end, begin, before[static_cast<std::size_t>(chunk)]);
  }
  values[count] = all;
  return all;
}

}  // namespace mesogen::exec
