#include "mesogen/mesh/fourier_transform.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mesogen/exec/random.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;

std::vector<double> noise(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t n = 0; n < count; ++n) values[n] = exec::random_uniform(7, static_cast<std::int64_t>(n), 0) - 0.5;
  return values;
}

TEST(FourierTransform, SizesAreFastAndNearWhatIsWanted) {
  EXPECT_EQ(fast_size(1.0), 8);
  EXPECT_EQ(fast_size(32.0), 32);
  EXPECT_EQ(fast_size(33.4), 32);
  EXPECT_EQ(fast_size(70.0), 72);
  EXPECT_EQ(fast_size(333.3), 324);
}

TEST(FourierTransform, AWaveIsItsMode) {
  const Grid<2> grid{{12, 10}, {3.0, 5.0}};
  FourierTransform transform(grid);
  std::vector<double> values(grid.point_count());
  // 0.5 + 2 cos(2 x' - 3 y' + 0.3)
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 12; ++x)
      values[static_cast<std::size_t>(y * 12 + x)] =
          0.5 + 2.0 * std::cos(2.0 * std::numbers::pi * (2.0 * x / 12.0 - 3.0 * y / 10.0) + 0.3);
  std::vector<Complex> modes(grid.mode_count());
  transform.forward(values.data(), modes.data());
  for (int row = 0; row < 10; ++row) {
    for (int n = 0; n < 7; ++n) {
      Complex expected(0.0);
      if (row == 0 && n == 0) expected = 0.5;
      if (row == 7 && n == 2) expected = std::polar(1.0, 0.3);
      EXPECT_LT(std::abs(modes[static_cast<std::size_t>(row * 7 + n)] - expected), 1e-15) << row << ", " << n;
    }
  }
  EXPECT_DOUBLE_EQ(grid.wave_number(1, 7), -3.0 * 2.0 * std::numbers::pi / 5.0);
  EXPECT_DOUBLE_EQ(grid.wave_number(0, 2), 2.0 * 2.0 * std::numbers::pi / 3.0);
}

template <int Dim>
void expect_back_again(const Grid<Dim>& grid) {
  FourierTransform transform(grid);
  const std::vector<double> values = noise(grid.point_count());
  std::vector<Complex> modes(grid.mode_count());
  transform.forward(values.data(), modes.data());
  std::vector<double> back(values.size());
  transform.backward(modes.data(), back.data());
  for (std::size_t n = 0; n < values.size(); ++n) ASSERT_NEAR(back[n], values[n], 1e-14);
}

// Rows of modes that are and are not a whole number of the bundles in which columns are transformed.
TEST(FourierTransform, BackwardUndoesForward) {
  expect_back_again(Grid<2>{{8, 8}, {1.0, 1.0}});
  expect_back_again(Grid<2>{{14, 30}, {1.0, 1.0}});
  expect_back_again(Grid<2>{{54, 20}, {1.0, 1.0}});
  expect_back_again(Grid<3>{{8, 12, 10}, {1.0, 1.0, 1.0}});
  expect_back_again(Grid<3>{{18, 8, 20}, {1.0, 1.0, 1.0}});
}

TEST(FourierTransform, AnyNumberOfThreadsGivesTheSameBits) {
  const Grid<2> grid{{60, 54}, {1.0, 1.0}};
  const std::vector<double> values = noise(grid.point_count());
  const auto with_threads = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    FourierTransform transform(grid);
    std::vector<Complex> modes(grid.mode_count());
    transform.forward(values.data(), modes.data());
    std::vector<double> back(values.size());
    auto copy = modes;
    transform.backward(copy.data(), back.data());
    omp_set_num_threads(before);
    return std::pair{modes, back};
  };
  EXPECT_EQ(with_threads(1), with_threads(3));
}

}  // namespace
