#include "mesogen/mesh/particle_spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesogen/exec/random.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::mesh;

constexpr double length = 2.0;

/// across x across particles about the points of a lattice, in a box of two by two metres.
struct Particles {
  std::vector<double> x, y;

  Particles(int across, double jitter) {
    const double spacing = length / across;
    for (int b = 0; b < across; ++b) {
      for (int a = 0; a < across; ++a) {
        const auto i = static_cast<std::int64_t>(x.size());
        x.push_back(spacing * (a + 0.5 + jitter * (2.0 * exec::random_uniform(1, i, 0) - 1.0)));
        y.push_back(spacing * (b + 0.5 + jitter * (2.0 * exec::random_uniform(1, i, 1) - 1.0)));
      }
    }
  }
  [[nodiscard]] Index count() const { return static_cast<Index>(x.size()); }
  [[nodiscard]] double wave(Index i) const {
    const auto n = static_cast<std::size_t>(i);
    return std::cos(2.0 * std::numbers::pi / length * (3.0 * x[n] - 2.0 * y[n]) + 0.4);
  }
};

/// Root mean square difference of all modes from those of Particles::wave.
template <class Real = double>
double error_of_fit(const Particles& particles, int points, int corrections) {
  ParticleSpectrum<2, Real> spectrum(Grid<2>{{points, points}, {length, length}});
  spectrum.locate({particles.x.data(), particles.y.data()}, particles.count());
  std::vector<Complex> modes(spectrum.mode_count());
  spectrum.template fit<1>([&](Index i, Real* number) { *number = static_cast<Real>(particles.wave(i)); },
                           {modes.data()}, corrections);
  double square = 0.0;
  const int in_row = spectrum.grid().modes_in_row();
  for (std::size_t n = 0; n < modes.size(); ++n) {
    const bool expected = n == static_cast<std::size_t>((points - 2) * in_row + 3);
    square += norm(modes[n] - (expected ? Complex(std::polar(0.5, 0.4)) : Complex(0.0)));
  }
  return std::sqrt(square);
}

// But for what a spline of points so far apart takes for the wave: sinc^4 of its images, 1e-4 with ten points a wave.
TEST(ParticleSpectrum, AWaveOnALatticeIsFound) {
  EXPECT_LT(error_of_fit(Particles(32, 0.0), 32, 0), 2e-4);
  EXPECT_LT(error_of_fit(Particles(64, 0.0), 32, 0), 1e-5);
  EXPECT_NEAR(std::log2(error_of_fit(Particles(16, 0.0), 16, 0) / error_of_fit(Particles(32, 0.0), 32, 0)), 4.0, 1.0);
}

TEST(ParticleSpectrum, CorrectionsFindItOnDisorderedParticles) {
  const Particles particles(48, 0.3);
  const double without = error_of_fit(particles, 32, 0);
  const double one = error_of_fit(particles, 32, 1);
  const double three = error_of_fit(particles, 32, 3);
  EXPECT_LT(without, 0.02);
  EXPECT_LT(one, 0.3 * without);
  EXPECT_LT(three, 0.3 * one);
  EXPECT_NEAR(error_of_fit<float>(particles, 32, 3), three, 1e-6);
}

TEST(ParticleSpectrum, AWaveIsInterpolatedToFourthOrder) {
  const Particles particles(20, 0.4);
  const auto error = [&]<class Real>(int points, Real) {
    ParticleSpectrum<2, Real> spectrum(Grid<2>{{points, points}, {length, length}});
    spectrum.locate({particles.x.data(), particles.y.data()}, particles.count());
    const std::size_t wave = static_cast<std::size_t>((points - 2) * spectrum.grid().modes_in_row() + 3);
    std::vector<double> off(static_cast<std::size_t>(particles.count()));
    spectrum.template evaluate<1>(
        [&](std::size_t n, const auto& k, Complex* mode) {
          *mode = n == wave ? Complex(std::polar(0.5, 0.4)) : Complex(0.0);
          if (n != wave) return;
          ASSERT_NEAR(k[0], 3.0 * 2.0 * std::numbers::pi / length, 1e-12);
          ASSERT_NEAR(k[1], -2.0 * 2.0 * std::numbers::pi / length, 1e-12);
        },
        [&](Index i, const Real* there) {
          off[static_cast<std::size_t>(i)] = std::abs(static_cast<double>(*there) - particles.wave(i));
        });
    return *std::ranges::max_element(off);
  };
  EXPECT_LT(error(24, 0.0), 2e-2);
  EXPECT_NEAR(std::log2(error(16, 0.0) / error(32, 0.0)), 4.0, 0.5);
  EXPECT_NEAR(error(32, 0.0F), error(32, 0.0), 1e-6);
}

TEST(ParticleSpectrum, ModesAreKeptUpToTwoThirdsAlongEachAxis) {
  const KeptModes<2> kept(Grid<2>{{24, 12}, {length, length}});
  std::vector<int> visits(kept.mode_count());
  kept.for_each([&](std::size_t n, const auto& k) {
    ++visits[n];
    EXPECT_LE(std::abs(k[0]), kept.cutoff(0) + 1e-9);
    EXPECT_LE(std::abs(k[1]), kept.cutoff(1) + 1e-9);
  });
  EXPECT_EQ(kept.in_row(), 9);
  EXPECT_EQ(kept.in_row(4), 9);
  EXPECT_EQ(kept.in_row(5), 0);
  EXPECT_EQ(kept.in_row(8), 9);
  // Wave numbers 0 to 8 along x, -4 to 4 along y, each once.
  EXPECT_EQ(std::ranges::count(visits, 1), 81);
  EXPECT_EQ(std::ranges::count(visits, 0), 13 * 12 - 81);
}

TEST(ParticleSpectrum, UnevennessIsTheDensityOfParticles) {
  // Displaced by a wave: density 1 - d(displacement)/dx to first order.
  Particles particles(64, 0.0);
  const double k = 2.0 * std::numbers::pi / length;
  for (double& x : particles.x) x += 0.001 * std::sin(k * x);
  ParticleSpectrum<2> spectrum(Grid<2>{{32, 32}, {length, length}});
  spectrum.locate({particles.x.data(), particles.y.data()}, particles.count());
  std::vector<Complex> modes(spectrum.mode_count());
  spectrum.unevenness(modes.data());
  EXPECT_NEAR(modes[1].real(), -0.5 * 0.001 * k, 1e-5 * 0.001 * k);
  EXPECT_NEAR(modes[1].imag(), 0.0, 1e-12);
  EXPECT_NEAR(abs(modes[0]), 0.0, 1e-14);
}

TEST(ParticleSpectrum, AVoidIsAnError) {
  // Nobody in a half of the box.
  Particles particles(32, 0.2);
  for (double& x : particles.x) x *= 0.5;
  ParticleSpectrum<2> spectrum(Grid<2>{{32, 32}, {length, length}});
  try {
    spectrum.locate({particles.x.data(), particles.y.data()}, particles.count());
    std::vector<Complex> modes(spectrum.mode_count());
    spectrum.unevenness(modes.data());
    FAIL() << "it was not noticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_STREQ(error.what(),
                 "a point of the mesh has hardly any particle about it: leave the shift of the flow at its default, or "
                 "take a coarser mesh (mesh_spacing of a flow on a mesh)");
  }
  particles.x[5] = std::nan("");
  try {
    spectrum.locate({particles.x.data(), particles.y.data()}, particles.count());
    FAIL() << "it was not noticed";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "the coordinate of a particle is not finite");
  }
}

}  // namespace
