#include "mesogen/mesh/particle_mesh.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesogen/exec/random.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;

/// Particles at random, some of them in images of the box.
template <int Dim>
struct Cloud {
  Grid<Dim> grid;
  std::array<std::vector<double>, Dim> position;

  explicit Cloud(const Grid<Dim>& on, Index count = 500) : grid(on) {
    for (int d = 0; d < Dim; ++d)
      for (Index i = 0; i < count; ++i)
        position[d].push_back(grid.length[d] * (3.0 * exec::random_uniform(3, i, d) - 1.0));
  }
  [[nodiscard]] Index count() const { return static_cast<Index>(position[0].size()); }
  template <class Real>
  void locate(ParticleMesh<Dim, Real>& mesh) const {
    std::array<const double*, Dim> at{};
    for (int d = 0; d < Dim; ++d) at[d] = position[d].data();
    mesh.locate(at, count());
  }
};

double number_of(Index i) { return exec::random_uniform(5, i, 9) - 0.3; }

/// The numbers of a field on a grid, row by row.
template <class Real>
std::vector<Real> numbers_of(const FieldsOnGrid<Real>& fields, int field, int points) {
  std::vector<Real> numbers;
  for (int row = 0; row < fields.row_count(); ++row)
    numbers.insert(numbers.end(), fields.row(field, row), fields.row(field, row) + points);
  return numbers;
}

template <int Dim>
void expect_sum_kept_and_adjoint(const Grid<Dim>& grid) {
  const Cloud<Dim> cloud(grid);
  ParticleMesh<Dim> mesh(grid);
  cloud.locate(mesh);
  FieldsOnGrid<double> fields(grid, 2);
  mesh.template spread<2>(
      [](Index i, double* numbers) {
        numbers[0] = number_of(i);
        numbers[1] = 1.0;
      },
      fields);
  const auto spread = numbers_of(fields, 0, grid.points[0]);
  double carried = 0.0;
  double arrived = 0.0;
  double particles = 0.0;
  for (Index i = 0; i < cloud.count(); ++i) carried += number_of(i);
  for (const double value : spread) arrived += value;
  for (const double value : numbers_of(fields, 1, grid.points[0])) particles += value;
  EXPECT_NEAR(arrived, carried, 1e-12 * cloud.count());
  EXPECT_NEAR(particles, cloud.count(), 1e-12 * cloud.count());

  // Interpolation has the same weights: <spread f, g> = <f, gather g> for any g, here five at once.
  constexpr int count = 5;
  FieldsOnGrid<double> field(grid, count);
  std::array<double, count> on_grid{};
  for (int c = 0; c < count; ++c) {
    std::size_t n = 0;
    for (int row = 0; row < grid.row_count(); ++row) {
      for (int x = 0; x < grid.points[0]; ++x, ++n) {
        field.row(c, row)[x] = exec::random_uniform(11, static_cast<std::int64_t>(n), c);
        on_grid[static_cast<std::size_t>(c)] += spread[n] * field.row(c, row)[x];
      }
    }
  }
  std::vector<std::array<double, count>> gathered(static_cast<std::size_t>(cloud.count()));
  mesh.template gather<count>(field, [&](Index i, const double* there) {
    std::copy(there, there + count, gathered[static_cast<std::size_t>(i)].begin());
  });
  for (std::size_t c = 0; c < count; ++c) {
    double at_particles = 0.0;
    for (Index i = 0; i < cloud.count(); ++i) at_particles += number_of(i) * gathered[static_cast<std::size_t>(i)][c];
    EXPECT_NEAR(on_grid[c], at_particles, 1e-12 * cloud.count());
  }
}

TEST(ParticleMesh, SpreadingKeepsTheSumAndIsTheAdjointOfGathering) {
  expect_sum_kept_and_adjoint(Grid<2>{{8, 12}, {1.0, 3.0}});
  expect_sum_kept_and_adjoint(Grid<3>{{10, 8, 12}, {1.0, 2.0, 0.5}});
}

TEST(ParticleMesh, LinearFieldsAreInterpolatedExactly) {
  const Grid<2> grid{{16, 20}, {4.0, 2.0}};
  ParticleMesh<2> mesh(grid);
  const double x[] = {1.37, 2.0, 1.01};
  const double y[] = {0.911, 1.0, 1.3};
  mesh.locate({x, y}, 3);
  FieldsOnGrid<double> field(grid, 1);
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 16; ++column) field.row(0, row)[column] = 1.0 + 2.0 * column * 0.25 - 3.0 * row * 0.1;
  std::vector<double> there(3);
  mesh.gather<1>(field, [&](Index i, const double* value) { there[static_cast<std::size_t>(i)] = *value; });
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(there[i], 1.0 + 2.0 * x[i] - 3.0 * y[i], 1e-14);
}

TEST(ParticleMesh, ImagesOfAParticleAreOne) {
  const Grid<2> grid{{8, 8}, {1.0, 1.0}};
  const auto spread = [&](double x, double y) {
    ParticleMesh<2> mesh(grid);
    mesh.locate({&x, &y}, 1);
    FieldsOnGrid<double> values(grid, 1);
    mesh.spread<1>([](Index, double* one) { *one = 1.0; }, values);
    return numbers_of(values, 0, 8);
  };
  const auto at = spread(0.03125, 0.96875);
  EXPECT_EQ(at, spread(1.03125, -0.03125));
  EXPECT_EQ(at, spread(-2.96875, 4.96875));
  // Its four points an axis lie on both sides of the face.
  EXPECT_GT(at[7 + 8 * 7], 0.0);
  EXPECT_GT(at[1 + 8 * 0], 0.0);
  EXPECT_EQ(at[4 + 8 * 4], 0.0);
}

// Of a linear field nothing is missing; of a field that is 0.25 higher, 0.25 of each particle.
TEST(ParticleMesh, WhatIsMissingIsSpread) {
  const Grid<2> grid{{16, 12}, {1.0, 1.0}};
  const Cloud<2> cloud(grid, 700);
  ParticleMesh<2> mesh(grid);
  cloud.locate(mesh);
  FieldsOnGrid<double> fields(grid, 2);
  FieldsOnGrid<double> weight(grid, 1);
  mesh.spread<1>([](Index, double* one) { *one = 1.0; }, weight);
  for (int row = 0; row < 12; ++row) {
    for (int x = 0; x < 16; ++x) {
      fields.row(0, row)[x] = 3.0;
      fields.row(1, row)[x] = -1.0;
    }
  }
  int rows = 0;
  mesh.spread_missing<2>(
      [](Index, double* numbers) {
        numbers[0] = 3.0;
        numbers[1] = -0.75;
      },
      fields,
      [&](int) {
#pragma omp atomic
        ++rows;
      });
  EXPECT_EQ(rows, 12);
  for (int row = 0; row < 12; ++row) {
    for (int x = 0; x < 16; ++x) {
      ASSERT_NEAR(fields.row(0, row)[x], 0.0, 1e-13);
      ASSERT_NEAR(fields.row(1, row)[x], 0.25 * weight.row(0, row)[x], 1e-13);
    }
  }
}

TEST(ParticleMesh, SinglePrecisionDiffersByRounding) {
  const Cloud<2> cloud(Grid<2>{{20, 12}, {1.0, 1.0}}, 3000);
  const auto spread = [&]<class Real>(Real) {
    ParticleMesh<2, Real> mesh(cloud.grid);
    cloud.locate(mesh);
    FieldsOnGrid<Real> values(cloud.grid, 3);
    mesh.template spread<3>(
        [](Index i, Real* numbers) {
          for (int c = 0; c < 3; ++c) numbers[c] = static_cast<Real>(c * number_of(i));
        },
        values);
    return numbers_of(values, 2, 20);
  };
  const auto in_single = spread(0.0F);
  const auto in_double = spread(0.0);
  for (std::size_t n = 0; n < in_double.size(); ++n) ASSERT_NEAR(in_single[n], in_double[n], 1e-5);
}

TEST(ParticleMesh, AnyNumberOfThreadsGivesTheSameBits) {
  const Cloud<2> cloud(Grid<2>{{20, 12}, {1.0, 1.0}}, 3000);
  const auto with_threads = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    ParticleMesh<2, float> mesh(cloud.grid);
    cloud.locate(mesh);
    FieldsOnGrid<float> values(cloud.grid, 1);
    const auto number = [](Index i, float* to) { *to = static_cast<float>(number_of(i)); };
    mesh.spread<1>(number, values);
    mesh.spread_missing<1>(number, values, [](int) {});
    omp_set_num_threads(before);
    return numbers_of(values, 0, 20);
  };
  EXPECT_EQ(with_threads(1), with_threads(3));
}

}  // namespace
