// The mesh on a device agrees with that on the host but for rounding; played by the host, with memory apart.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "error_of.hpp"
#include "exec/emulated_memory.hpp"
#include "mesh/emulated_mesh.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/mesh/pass_spectrum.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;
using exec::Access;
using exec::Array;

/// Particles near the points of a lattice, some of them in images of the box.
template <int Dim>
struct Cloud {
  std::array<Array<double>, Dim> position;
  Array<double> value;
  Index count = 1;

  Cloud(exec::DeviceMemory* memory, const Grid<Dim>& grid, double jitter) : value(memory) {
    Grid<Dim> lattice = grid;
    for (int& points : lattice.points) points = points * 3 / 2;
    count = static_cast<Index>(lattice.point_count());
    std::array<std::vector<double>, Dim> at;
    std::vector<double> values;
    for (Index i = 0; i < count; ++i) {
      Index rest = i;
      for (int d = 0; d < Dim; ++d) {
        const double off = 0.5 + jitter * (exec::random_uniform(1, i, d) - 0.5);
        const int image = i % 7 == 3 ? i % 5 - 2 : 0;
        at[d].push_back((rest % lattice.points[d] + off) * lattice.spacing(d) + image * lattice.length[d]);
        rest /= lattice.points[d];
      }
      values.push_back(std::cos(2.0 * std::numbers::pi *
                                (2.0 * at[0].back() / grid.length[0] - 3.0 * at[1].back() / grid.length[1])) +
                       0.2 * exec::random_uniform(2, i, 0));
    }
    for (int d = 0; d < Dim; ++d) {
      position[d] = Array<double>(memory);
      position[d].assign(at[d]);
    }
    value.assign(values);
  }
  [[nodiscard]] std::array<const double*, Dim> places() const {
    std::array<const double*, Dim> all{};
    for (int d = 0; d < Dim; ++d) all[d] = position[d].device();
    return all;
  }
};

/// Two fields: the value of a particle, and half of it.
template <class Real>
struct Values {
  const double* value;
  void operator()(Index i, Real* numbers) const {
    numbers[0] = static_cast<Real>(value[i]);
    numbers[1] = static_cast<Real>(0.5 * value[i]);
  }
};
/// The slope of a field along the last axis, and what `extra` has.
template <int Dim>
struct SlopeAndMore {
  const Complex* field;
  const Complex* extra;
  void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* modes) const {
    modes[0] = derivative(k[Dim - 1], field[n]);
    modes[1] = extra[n];
  }
};
template <class Real>
struct Put {
  double* to;
  void operator()(Index i, const Real* there) const {
    to[2 * i] = static_cast<double>(there[0]);
    to[2 * i + 1] = static_cast<double>(there[1]);
  }
};
template <int Dim>
struct Energy {
  const Complex* field;
  void operator()(std::size_t n, const std::array<double, Dim>& k, int x, double& sum) const {
    sum += (x == 0 ? 1.0 : 2.0) * KeptModes<Dim>::square(k) * norm(field[n]);
  }
};
template <class Real>
struct Square {
  void operator()(const Real* before, Real* after) const {
    after[0] = before[0] * before[0];
    after[1] = before[0];
  }
};
struct Take {
  Complex* to;
  template <class WaveVector>
  void operator()(std::size_t n, const WaveVector&, const Complex* numbers) const {
    to[n] = numbers[0];
  }
};

struct Found {
  std::vector<double> at_particles, uneven, square;
  double energy = 0.0;
  bool operator==(const Found&) const = default;
};

std::vector<double> numbers_of(const Array<Complex>& modes) {
  std::vector<double> numbers;
  for (const Complex& mode : modes.host()) numbers.insert(numbers.end(), {mode.re, mode.im});
  return numbers;
}

/// All that a PassSpectrum offers, on the host if `device` is null.
template <int Dim, class Real>
Found all_of(const DeviceMesh* device, const Grid<Dim>& grid, double jitter) {
  PassSpectrum<Dim, Real> spectrum(grid, device);
  const Cloud<Dim> cloud(spectrum.memory(), grid, jitter);
  std::array<double, Dim> origin{};
  origin[0] = 0.3 * grid.spacing(0);
  spectrum.locate(cloud.places(), cloud.count, origin);
  const auto modes = [&] {
    Array<Complex> all(spectrum.memory());
    all.resize(spectrum.mode_count());
    return all;
  };
  auto whole = modes();
  auto half = modes();
  auto uneven = modes();
  auto square = modes();
  spectrum.template fit<2>(Values<Real>{cloud.value.device()},
                           {whole.device(Access::read_write), half.device(Access::read_write)}, 3);
  spectrum.unevenness(uneven.device(Access::read_write));
  Array<double> there(spectrum.memory());
  there.resize(2 * static_cast<std::size_t>(cloud.count));
  spectrum.template evaluate<2>(SlopeAndMore<Dim>{whole.device(), half.device()},
                                Put<Real>{there.device(Access::read_write)});
  Found found;
  found.energy = spectrum.modes().sum(Energy<Dim>{whole.device()});
  const Complex* const first = whole.device();
  spectrum.with_transform([&](auto& transform) {
    transform.hold_points(2);
    transform.template to_points<1>([first](std::size_t n, const auto&, Complex* to) { *to = first[n]; });
    transform.template change_points<1, 2>(Square<Real>{});
    transform.template to_modes<2>(Take{square.device(Access::read_write)});
  });
  found.at_particles.assign(there.host().begin(), there.host().end());
  found.uneven = numbers_of(uneven);
  found.square = numbers_of(square);
  return found;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double within) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    largest = std::max(largest, std::abs(b[n]));
    difference = std::max(difference, std::abs(a[n] - b[n]));
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(difference, within * largest);
}

template <int Dim, class Real>
void expect_that_of_the_host(const Grid<Dim>& grid, double within) {
  exec::EmulatedMemory memory;
  const EmulatedMesh device(memory);
  for (const double jitter : {0.0, 0.8}) {
    const Found host = all_of<Dim, Real>(nullptr, grid, jitter);
    const Found found = all_of<Dim, Real>(&device, grid, jitter);
    expect_near(found.at_particles, host.at_particles, within);
    if (jitter > 0.0) expect_near(found.uneven, host.uneven, within);
    expect_near(found.square, host.square, within);
    EXPECT_NEAR(found.energy, host.energy, within * host.energy);
    EXPECT_EQ(found, (all_of<Dim, Real>(&device, grid, jitter)));
  }
  EXPECT_EQ(memory.held(), 0U);
}

TEST(DeviceSpectrum, IsThatOfTheHost) {
  expect_that_of_the_host<2, double>(Grid<2>{{24, 20}, {2.0, 1.5}}, 1e-12);
  expect_that_of_the_host<2, float>(Grid<2>{{24, 20}, {2.0, 1.5}}, 1e-4);
  expect_that_of_the_host<3, double>(Grid<3>{{12, 10, 8}, {2.0, 1.5, 1.0}}, 1e-12);
}

// What a point of the grid adds up, by the definition of the spline.
TEST(DeviceSpectrum, SplinesAreThoseOfTheHost) {
  using Cells = CellsOfParticles<2, double>;
  for (const double f : {0.0, 0.3, 0.75, 0.999}) {
    double sum = 0.0;
    double moment = 0.0;
    for (int by = 0; by < 4; ++by) {
      sum += Cells::spline(by, f);
      moment += (by - 1) * Cells::spline(by, f);
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_NEAR(moment, f, 1e-15);
    EXPECT_NEAR(Cells::spline(3, f), f * f * f / 6.0, 1e-15);
  }
}

TEST(DeviceSpectrum, TheListOfModesIsThatOfTheRows) {
  for (const Grid<3>& grid : {Grid<3>{{12, 10, 8}, {2.0, 1.5, 1.0}}, Grid<3>{{8, 8, 24}, {1.0, 1.0, 1.0}}}) {
    const KeptModes<3> kept(grid);
    const ModeList<3> list(kept);
    std::vector<Index> of(grid.mode_count(), -1);
    for (Index j = 0; j < list.count(); ++j) of[list[j].n] = j;
    Index number = 0;
    for (int row = 0; row < grid.row_count(); ++row) {
      kept.for_each_in_row(row, [&](std::size_t n, const auto& k, int x) {
        ++number;
        ASSERT_GE(of[n], 0);
        EXPECT_EQ(list[of[n]].k, k);
        EXPECT_EQ(list[of[n]].x, x);
        Mode<3> found{};
        EXPECT_TRUE(list.find(static_cast<Index>(n), found));
        EXPECT_EQ(found.k, k);
      });
    }
    EXPECT_EQ(number, list.count());
    Index kept_by_find = 0;
    Mode<3> mode{};
    for (Index n = 0; n < list.stored(); ++n) kept_by_find += list.find(n, mode) ? 1 : 0;
    EXPECT_EQ(kept_by_find, number);
  }
}

TEST(DeviceSpectrum, AVoidIsAnError) {
  exec::EmulatedMemory memory;
  const EmulatedMesh device(memory);
  const Grid<2> grid{{16, 16}, {1.0, 1.0}};
  Cloud<2> cloud(&memory, grid, 0.2);
  PassSpectrum<2> spectrum(grid, &device);
  Array<Complex> modes(&memory);
  modes.resize(spectrum.mode_count());
  const auto unevenness = [&] {
    spectrum.locate(cloud.places(), cloud.count);
    return error_of([&] { spectrum.unevenness(modes.device(Access::read_write)); }, ExitCode::run_failed);
  };
  for (double& x : cloud.position[0].host(Access::read_write)) x = 0.25 + 0.1 * std::sin(x);
  EXPECT_EQ(unevenness(),
            "a point of the mesh has hardly any particle about it: leave the shift of the flow at its default, or "
            "take a coarser mesh (mesh_spacing of a flow on a mesh)");
  cloud.position[0].host(Access::read_write)[5] = std::nan("");
  EXPECT_EQ(unevenness(), "the coordinate of a particle is not finite");
}

}  // namespace
