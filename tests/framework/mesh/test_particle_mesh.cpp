#include "mesogen/mesh/particle_mesh.hpp"

#include <gtest/gtest.h>
#include <omp.h>

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
  void locate(ParticleMesh<Dim>& mesh) const {
    std::array<const double*, Dim> at{};
    for (int d = 0; d < Dim; ++d) at[d] = position[d].data();
    mesh.locate(at, count());
  }
};

double number_of(Index i) { return exec::random_uniform(5, i, 9) - 0.3; }

template <int Dim>
void expect_sum_kept_and_adjoint(const Grid<Dim>& grid) {
  const Cloud<Dim> cloud(grid);
  ParticleMesh<Dim> mesh(grid);
  cloud.locate(mesh);
  std::vector<double> spread(grid.point_count());
  std::vector<double> ones(grid.point_count());
  mesh.template spread<2>(
      [](Index i, double* numbers) {
        numbers[0] = number_of(i);
        numbers[1] = 1.0;
      },
      {spread.data(), ones.data()});
  double carried = 0.0;
  double arrived = 0.0;
  double particles = 0.0;
  for (Index i = 0; i < cloud.count(); ++i) carried += number_of(i);
  for (const double value : spread) arrived += value;
  for (const double value : ones) particles += value;
  EXPECT_NEAR(arrived, carried, 1e-12 * cloud.count());
  EXPECT_NEAR(particles, cloud.count(), 1e-12 * cloud.count());

  // Interpolation has the same weights: <spread f, g> = <f, gather g> for any g.
  std::vector<double> field(grid.point_count());
  for (std::size_t n = 0; n < field.size(); ++n) field[n] = exec::random_uniform(11, static_cast<std::int64_t>(n), 0);
  double on_grid = 0.0;
  for (std::size_t n = 0; n < field.size(); ++n) on_grid += spread[n] * field[n];
  std::vector<double> gathered(static_cast<std::size_t>(cloud.count()), std::nan(""));
  mesh.template gather<1>({field.data()},
                          [&](Index i, const double* there) { gathered[static_cast<std::size_t>(i)] = *there; });
  double at_particles = 0.0;
  for (Index i = 0; i < cloud.count(); ++i) at_particles += number_of(i) * gathered[static_cast<std::size_t>(i)];
  EXPECT_NEAR(on_grid, at_particles, 1e-12 * cloud.count());
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
  std::vector<double> field(grid.point_count());
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 16; ++column)
      field[static_cast<std::size_t>(row * 16 + column)] = 1.0 + 2.0 * column * 0.25 - 3.0 * row * 0.1;
  std::vector<double> there(3);
  mesh.gather<1>({field.data()}, [&](Index i, const double* value) { there[static_cast<std::size_t>(i)] = *value; });
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(there[i], 1.0 + 2.0 * x[i] - 3.0 * y[i], 1e-14);
}

TEST(ParticleMesh, ImagesOfAParticleAreOne) {
  const Grid<2> grid{{8, 8}, {1.0, 1.0}};
  const auto spread = [&](double x, double y) {
    ParticleMesh<2> mesh(grid);
    mesh.locate({&x, &y}, 1);
    std::vector<double> values(grid.point_count());
    mesh.spread<1>([](Index, double* one) { *one = 1.0; }, {values.data()});
    return values;
  };
  const auto at = spread(0.03125, 0.96875);
  EXPECT_EQ(at, spread(1.03125, -0.03125));
  EXPECT_EQ(at, spread(-2.96875, 4.96875));
  // Its four points an axis lie on both sides of the face.
  EXPECT_GT(at[7 + 8 * 7], 0.0);
  EXPECT_GT(at[1 + 8 * 0], 0.0);
  EXPECT_EQ(at[4 + 8 * 4], 0.0);
}

TEST(ParticleMesh, AnyNumberOfThreadsGivesTheSameBits) {
  const Cloud<2> cloud(Grid<2>{{20, 12}, {1.0, 1.0}}, 3000);
  const auto with_threads = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    ParticleMesh<2> mesh(cloud.grid);
    cloud.locate(mesh);
    std::vector<double> values(cloud.grid.point_count());
    mesh.spread<1>([](Index i, double* number) { *number = number_of(i); }, {values.data()});
    omp_set_num_threads(before);
    return values;
  };
  EXPECT_EQ(with_threads(1), with_threads(3));
}

}  // namespace
