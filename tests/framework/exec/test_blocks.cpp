#include <gtest/gtest.h>
#include <omp.h>

#include <vector>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/for_each.hpp"

namespace mesogen::exec {
namespace {

TEST(Blocks, CoverAllOnceAndBeginAtMultiplesOfWhatAnyVectorHolds) {
  for (const Index count : {0, 1, 63, 64, 65, 400, 1000}) {
    const Blocks blocks(count);
    Index next = 0;
    for (Index b = 0; b < blocks.number(); ++b) {
      EXPECT_EQ(blocks.begin(b), next);
      EXPECT_EQ(blocks.begin(b) % 16, 0);
      EXPECT_GT(blocks.end(b), blocks.begin(b)) << count;
      next = blocks.end(b);
    }
    EXPECT_EQ(next, count);
  }
}

/// Rounds differently where it is contracted to fused multiply-adds and where not.
struct Polynomial {
  const float* x;
  float* y;
  void operator()(Index i) const { y[i] = x[i] * x[i] - 0.3F * x[i] + x[i] * 1.7F * x[i] * x[i]; }
};

TEST(ForEach, GivesTheSameBitsFromAnyNumberOfThreads) {
  constexpr Index count = 1237;
  std::vector<float> x(count);
  for (Index i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = 0.001F * static_cast<float>(i) + 0.1F;
  const int before = omp_get_max_threads();
  const auto with = [&](int threads) {
    omp_set_num_threads(threads);
    std::vector<float> y(count);
    for_each(Space{}, count, Polynomial{x.data(), y.data()});
    omp_set_num_threads(before);
    return y;
  };
  const auto one = with(1);
  for (const int threads : {2, 3, 5}) EXPECT_EQ(with(threads), one) << threads;
}

}  // namespace
}  // namespace mesogen::exec
