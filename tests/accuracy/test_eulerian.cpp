// Particles that stay: the fields flow past them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double pi = std::numbers::pi;

/// v = a exp(-nu k^2 t) cos(k (x - U t)) is carried along by a uniform flow U: relative error of its complex amplitude.
double error_of_wave(int across) {
  constexpr double nu = 0.02;
  constexpr double speed = 0.5;
  constexpr double amplitude = 0.1;
  constexpr double end = 1.0;
  CaseText text(1.0, across);
  // A shear wave of the stream function -a / k sin(k x) on top of the uniform flow is set field by field below.
  text.flow(nu, "sound_speed = 6.0\nmotion = \"eulerian\"")
      .section("velocity", "type = \"uniform\"\nvalue = [0.5, 0.0]")
      .section("time", "end = 10.0\nscheme = \"midpoint\"");
  CaseRun run(text);
  auto& state = run.state();
  auto& velocity = state.fields.at("velocity");
  for (mesogen::Index i = 0; i < state.particles.count(); ++i)
    velocity.set(1, i,
                 amplitude * std::cos(2.0 * pi * state.particles.position[0].host()[static_cast<std::size_t>(i)]));
  ++velocity.version;
  run.stepper().start();
  run.run_to(end);
  const Wave wave = wave_of(run, run.field("velocity", 1), 1, 0);
  const double left = amplitude * std::exp(-nu * 4.0 * pi * pi * end);
  const double phase = 2.0 * pi * speed * end;
  EXPECT_EQ(state.neighbourhood.sortings(), 1) << "neighbours are found once";
  EXPECT_EQ(run.path(0), CaseRun(text).path(0)) << "nobody moves";
  return std::hypot(wave.cosine - left * std::cos(phase), wave.sine - left * std::sin(phase)) / left;
}

TEST(Eulerian, CarriesAWaveAlongInSecondOrder) {
  const double coarse = error_of_wave(20);
  const double fine = error_of_wave(40);
  EXPECT_LT(fine, 0.05);
  EXPECT_GT(std::log2(coarse / fine), 1.7) << coarse << " to " << fine;
}

TEST(Eulerian, RefusesWhatFollowsParticles) {
  CaseText text(1.0, 20);
  text.flow(0.1, "motion = \"eulerian\"").section("colour", "type = \"quarter\"");
  try {
    CaseRun run(text);
    FAIL();
  } catch (const mesogen::Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("in the Eulerian motion of 'physics.flow' particles stay where they are, so what it sets "
                        "would not move; remove it, or take motion = \"lagrangian\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
