// A standing sound wave: the energy that compression stores turns into motion and back.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double sound_speed = 10.0;  // box of 1 m, 1 kg/m3
constexpr double amplitude = 1e-3;    // of rho / rho0 - 1

/// c = amplitude cos(2 pi x), at rest, with next to no viscosity.
CaseRun standing_wave(int across) {
  CaseText text(1.0, across);
  text.flow(1e-6, "sound_speed = 10.0\ndensity_diffusion = 0.0")
      .read(R"("velocity", "density", "volume", "velocity_gradient", "internal_energy")");
  CaseRun run(text);
  Field& compression = run.state().fields.at("compression");
  const auto x = run.state().particles.position[0].host();
  for (Index i = 0; i < run.state().particles.count(); ++i)
    compression.set(0, i, amplitude * std::cos(2.0 * std::numbers::pi * x[static_cast<std::size_t>(i)]));
  ++compression.version;
  return run;
}

TEST(SoundWave, MotionAndCompressionShareOneEnergy) {
  CaseRun run = standing_wave(32);
  run.run_steps(1);  // brings derived fields up to date
  const double exact = 0.25 * sound_speed * sound_speed * amplitude * amplitude;
  double most_kinetic = 0.0;
  double largest = 0.0;
  const double period = 1.0 / sound_speed;
  for (int n = 1; n <= 32; ++n) {
    run.run_to(period * n / 16.0);
    const double kinetic = run.observe("flow_statistics", "kinetic_energy");
    const double compression = run.observe("flow_statistics", "compression_energy");
    most_kinetic = std::max(most_kinetic, kinetic);
    largest = std::max(largest, std::abs((kinetic + compression) / exact - 1.0));
    if (n == 16) {  // a period later all of it is in compression
      EXPECT_NEAR(compression / exact, 1.0, 0.01);
    }
  }
  EXPECT_NEAR(most_kinetic / exact, 1.0, 0.01);
  EXPECT_LT(largest, 0.008);
}

}  // namespace
