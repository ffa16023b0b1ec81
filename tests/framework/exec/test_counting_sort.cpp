#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "mesogen/exec/counting_sort.hpp"

namespace mesogen::exec {
namespace {

TEST(CountingSort, IsStableWithAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3, 5}) {
    omp_set_num_threads(threads);
    for (const Index count : {0, 1, 2, 7, 1000, 4097}) {
      const auto bucket_of = [](Index i) { return i * 7919 % 13 + (i % 3 == 0 ? 0 : 1); };
      std::vector<Index> wanted(static_cast<std::size_t>(count));
      std::iota(wanted.begin(), wanted.end(), 0);
      std::stable_sort(wanted.begin(), wanted.end(), [&](Index a, Index b) { return bucket_of(a) < bucket_of(b); });
      std::vector<Index> sorted(wanted.size(), -1);
      const auto begin =
          counting_sort(count, 15, bucket_of, [&](Index i, Index to) { sorted[static_cast<std::size_t>(to)] = i; });
      EXPECT_EQ(sorted, wanted) << count << " with " << threads << " threads";
      ASSERT_EQ(begin.size(), 16u);
      for (Index bucket = 0; bucket < 16; ++bucket)
        EXPECT_EQ(begin[static_cast<std::size_t>(bucket)],
                  std::count_if(wanted.begin(), wanted.end(), [&](Index i) { return bucket_of(i) < bucket; }))
            << bucket;
    }
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace mesogen::exec
