#include "exec/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace {

using namespace mesogen;

TEST(LargePages, HoldWhatIsWritten) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, (std::size_t{5} << 20) / sizeof(double)}) {
    std::vector<double, exec::LargePages<double>> numbers(count);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0U);
    std::iota(numbers.begin(), numbers.end(), 1.0);
    EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0.0), 0.5 * double(count) * double(count + 1));
  }
}

TEST(LargePages, AreAsManyAsAskedFor) {
  std::vector<float, exec::LargePages<float>> numbers(3 << 20, 1.0F);
  numbers.resize(std::size_t{4} << 20, 2.0F);
  EXPECT_EQ(numbers[(3 << 20) - 1], 1.0F);
  EXPECT_EQ(numbers.back(), 2.0F);
}

}  // namespace
