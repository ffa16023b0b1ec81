#include "mesogen/mesh/fourier_transform.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "mesogen/exec/random.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;

TEST(FourierTransform, SizesAreFastAndNearWhatIsWanted) {
  EXPECT_EQ(fast_size(1.0), 8);
  EXPECT_EQ(fast_size(32.0), 32);
  EXPECT_EQ(fast_size(33.4), 32);
  EXPECT_EQ(fast_size(70.0), 72);
  EXPECT_EQ(fast_size(333.3), 324);
}

/// Calls action(row, x, value) for all points of a field.
template <class Real, class Action>
void for_each_point(FieldsOnGrid<Real>& fields, int field, int points, const Action& action) {
  for (int row = 0; row < fields.row_count(); ++row)
    for (int x = 0; x < points; ++x) action(row, x, fields.row(field, row)[x]);
}

template <class Real>
FieldsOnGrid<Real> noise_on(const auto& grid, int count) {
  FieldsOnGrid<Real> fields(grid, count);
  for (int c = 0; c < count; ++c)
    for_each_point(fields, c, grid.points[0], [&](int row, int x, Real& value) {
      value = static_cast<Real>(exec::random_uniform(7 + static_cast<std::uint64_t>(c), row, x) - 0.5);
    });
  return fields;
}

// 0.5 + 2 cos(2 x' - 3 y' + 0.3)
template <class Real>
void expect_wave_is_mode(double within) {
  const Grid<2> grid{{12, 10}, {3.0, 5.0}};
  FourierTransform<Real> transform(grid);
  FieldsOnGrid<Real> values(grid, 1);
  for_each_point(values, 0, 12, [](int y, int x, Real& value) {
    value = static_cast<Real>(0.5 + 2.0 * std::cos(2.0 * std::numbers::pi * (2.0 * x / 12.0 - 3.0 * y / 10.0) + 0.3));
  });
  FieldsOnGrid<Real> modes(grid, 1);
  transform.forward(values, modes, 1);
  for (int row = 0; row < 10; ++row) {
    for (int n = 0; n < 7; ++n) {
      Complex expected(0.0);
      if (row == 0 && n == 0) expected = 0.5;
      if (row == 7 && n == 2) expected = std::polar(1.0, 0.3);
      EXPECT_LT(abs(Complex(modes.modes(0, row)[n]) - expected), within) << row << ", " << n;
    }
  }
}

TEST(FourierTransform, AWaveIsItsMode) {
  expect_wave_is_mode<double>(1e-15);
  expect_wave_is_mode<float>(3e-7);
  const Grid<2> grid{{12, 10}, {3.0, 5.0}};
  EXPECT_DOUBLE_EQ(grid.wave_number(1, 7), -3.0 * 2.0 * std::numbers::pi / 5.0);
  EXPECT_DOUBLE_EQ(grid.wave_number(0, 2), 2.0 * 2.0 * std::numbers::pi / 3.0);
}

template <class Real, int Dim>
void expect_back_again(const Grid<Dim>& grid, double within) {
  FourierTransform<Real> transform(grid);
  const auto values = noise_on<Real>(grid, 2);
  FieldsOnGrid<Real> modes(grid, 2);
  transform.forward(values, modes, 2);
  FieldsOnGrid<Real> back(grid, 2);
  transform.backward(modes, back, 2);
  for (int c = 0; c < 2; ++c)
    for_each_point(back, c, grid.points[0],
                   [&](int row, int x, Real value) { ASSERT_NEAR(value, values.row(c, row)[x], within); });
}

// Rows of modes that are and are not a whole number of the bundles in which columns are transformed.
TEST(FourierTransform, BackwardUndoesForward) {
  expect_back_again<double>(Grid<2>{{8, 8}, {1.0, 1.0}}, 1e-14);
  expect_back_again<double>(Grid<2>{{14, 30}, {1.0, 1.0}}, 1e-14);
  expect_back_again<float>(Grid<2>{{54, 20}, {1.0, 1.0}}, 1e-6);
  expect_back_again<double>(Grid<3>{{8, 12, 10}, {1.0, 1.0, 1.0}}, 1e-14);
  expect_back_again<float>(Grid<3>{{18, 8, 20}, {1.0, 1.0, 1.0}}, 1e-6);
}

// Left out are others, not these.
TEST(FourierTransform, KeptModesAreThoseOfAWholeTransform) {
  const Grid<2> grid{{30, 20}, {1.0, 1.0}};
  const auto values = noise_on<double>(grid, 1);
  FieldsOnGrid<double> all(grid, 1);
  FieldsOnGrid<double> some(grid, 1);
  FourierTransform<double>(grid).forward(values, all, 1);
  FourierTransform<double>(grid, 11).forward(values, some, 1);
  for (int row = 0; row < 20; ++row)
    for (int n = 0; n < 11; ++n) ASSERT_LT(abs(all.modes(0, row)[n] - some.modes(0, row)[n]), 1e-15);
}

TEST(FourierTransform, AnyNumberOfThreadsGivesTheSameBits) {
  const Grid<2> grid{{60, 54}, {1.0, 1.0}};
  const auto values = noise_on<float>(grid, 3);
  const auto with_threads = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    FourierTransform<float> transform(grid, 21);
    FieldsOnGrid<float> modes(grid, 3);
    transform.forward(values, modes, 3);
    std::vector<float> numbers;
    for (int row = 0; row < 54; ++row) numbers.insert(numbers.end(), modes.row(2, row), modes.row(2, row) + 42);
    for (int c = 0; c < 3; ++c)
      for (int row = 0; row < 54; ++row)
        for (int n = 21; n < 31; ++n) modes.modes(c, row)[n] = 0.0F;
    FieldsOnGrid<float> back(grid, 3);
    transform.backward(modes, back, 3);
    for (int c = 0; c < 3; ++c) for_each_point(back, c, 60, [&](int, int, float value) { numbers.push_back(value); });
    omp_set_num_threads(before);
    return numbers;
  };
  EXPECT_EQ(with_threads(1), with_threads(3));
}

}  // namespace
