// A run that breaks down says where, and what to do.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "active_scene.hpp"
#include "run/closest_pair.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

std::string failure(CaseRun& run, int steps) {
  try {
    run.run_steps(steps);
  } catch (const Error& error) {
    return error.code() == ExitCode::run_failed ? error.what() : "another exit code";
  }
  return "no error";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "not in: " << text;
}

void expect_matches(const std::string& text, const std::string& pattern) {
  EXPECT_TRUE(std::regex_match(text, std::regex(pattern))) << "it says: " << text;
}

const std::string somewhere = R"( \(([0-9.e-]+), ([0-9.e-]+)\))";
const std::string keep_apart =
    R"(Leave the shift of the flow at its default, or take a smaller time\.step, or leave it to "auto"; )"
    "the frames before are kept";

CaseText short_steps(const std::string& precision, const std::string& boundary = "periodic_ghosts") {
  return active_scene(precision, boundary).section("time", "end = 1e6\nstep = 1e-6");
}

Index place_of(CaseRun& run, std::int64_t particle) {
  const auto id = run.state().particles.id.host();
  return static_cast<Index>(std::find(id.begin(), id.end(), particle) - id.begin());
}

void put(CaseRun& run, std::int64_t particle, double x, double y) {
  const Index place = place_of(run, particle);
  run.state().particles.position[0].host(exec::Access::read_write)[static_cast<std::size_t>(place)] = x;
  run.state().particles.position[1].host(exec::Access::read_write)[static_cast<std::size_t>(place)] = y;
  run.state().order.mark_moved();
}

TEST(Guard, AbsurdStepRunsAway) {
  CaseRun run(active_scene("double").section("time", "end = 1e6\nstep = 0.4"));
  expect_matches(failure(run, 20),
                 "the run ran away: the largest speed, [0-9.]+ m/s of particle [0-9]+" + somewhere +
                     R"(, carries it over 0\.5 spacings in one step at t = 0\.4 s \(step 1, step size 0\.4 s\)\. )" +
                     keep_apart);
}

TEST(Guard, AutomaticStepThatRunsAwayIsNotBlamedOnTimeStep) {
  CaseRun run(active_scene("double"));
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  checkpoint.numbers.at("field velocity 0")[static_cast<std::size_t>(place_of(run, 77))] = 1e6;
  run.stepper().restore(checkpoint);
  run.stepper().start();
  const std::string text = [&] {
    try {
      run.stepper().advance({.seconds = 0.01, .arrival = run.time() + 0.01, .limit = {}}, {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  }();
  expect_contains(text, "the run ran away: the largest speed, ");
  expect_contains(
      text,
      ". Leave the shift of the flow at its default, or take a smaller step (time.factor = 0.5); the frames before are "
      "kept");
}

TEST(Guard, AutomaticStepThatCollapsesIsGivenUp) {
  CaseRun run(active_scene("double"));
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  checkpoint.numbers.at("field velocity 0")[static_cast<std::size_t>(place_of(run, 77))] = 1e6;
  run.stepper().restore(checkpoint);
  expect_matches(
      failure(run, 1),
      "the run ran away: the largest speed, [0-9.e+]+ m/s of particle 77" + somewhere +
          ", and acceleration, [0-9.e+]+ m/s2 of particle [0-9]+" + somewhere +
          R"(, ask for steps of [0-9.e-]+ s \((speed: 0\.2 dx / \|u\||acceleration: 0\.25 sqrt\(h / \|a\|\))\), )"
          R"(where the fluid at rest allows [0-9.e-]+ s at t = [0-9.e-]+ s \(step 1, step size [0-9.e-]+ s\)\. )"
          R"(If the flow is meant to be so fast, give the step by time\.step; the frames before are kept)");
}

// Its velocity follows from modes: nobody has its acceleration.
TEST(Guard, AFlowInModesThatRunsAwayIsGivenUp) {
  CaseText text(4.0, 24);
  text.section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05");
  text.modes("director", "[[1, 0, 0.4, 0.3]]").nematic(0.4, 0.7, 0.02).section("time", "end = 10.0");
  CaseRun run(text);
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  auto& modes = checkpoint.numbers.at("physics.flow keeps velocity");
  modes[modes.size() / 2 + 2] = 1e6;  // of v, the first wave along x
  checkpoint.numbers.at("field velocity 0")[static_cast<std::size_t>(place_of(run, 77))] = 1e6;
  run.stepper().restore(checkpoint);
  expect_matches(
      failure(run, 1),
      "the run ran away: the largest speed, [0-9.e+]+ m/s of particle [0-9]+" + somewhere +
          R"(, asks for steps of [0-9.e-]+ s \(speed: 0\.2 dx / \|u\|\), where the fluid at rest allows )"
          R"([0-9.e-]+ s at t = [0-9.e-]+ s \(step 1, step size [0-9.e-]+ s\)\. If the flow is meant to be so )"
          R"(fast, give the step by time\.step; the frames before are kept)");
}

TEST(Guard, BoundsOfAFieldAreThoseOfItsPlugin) {
  for (const char* const precision : {"single", "double"}) {
    for (const double value : {0.35, -0.35}) {
      CaseRun run(short_steps(precision));
      run.run_steps(4);
      Field& compression = run.state().fields.at("compression");
      compression.set(0, place_of(run, 123), value);
      ++compression.version;
      // In storage order an earlier one, but less far outside.
      compression.set(0, place_of(run, 3), value / 0.35 * 0.31);
      expect_matches(
          failure(run, 1),
          "the run broke down: 'compression' is " + std::string(value < 0 ? "-" : "") +
              "0\\.3[45][0-9]* at particle 123" + somewhere +
              R"(, outside -0\.3 to 0\.3, at t = 5e-06 s \(step 5, step size 1e-06 s\)\. )"
              R"(If the flow is faster than a tenth of the sound, leave sound_speed and time\.step at "auto", where )"
              R"(the sound adapts, or raise sound_speed; else leave the shift on and )"
              R"(time\.scheme at "midpoint", or take a smaller step )"
              R"(\(time\.factor = 0\.5\); )"
              "the frames before are kept");
    }
  }
}

TEST(Guard, ValuesInsideTheirBoundsPass) {
  CaseRun run(short_steps("single"));
  Field& compression = run.state().fields.at("compression");
  compression.set(0, place_of(run, 123), 0.29);
  ++compression.version;
  EXPECT_EQ(failure(run, 2), "no error");
}

// Particles 0 to 399 stand on a lattice of 20 x 20, 0.2 m apart, row by row, half a spacing from the faces.
TEST(Guard, ParticlesThatGatherAreNamed) {
  CaseRun run(short_steps("single"));
  for (int n = 0; n < 16; ++n) put(run, n, 2.0 + 0.05 * (n % 4), 2.0 + 0.05 * (n / 4));
  expect_matches(
      failure(run, 1),
      "the run broke down: the volume of particle [0-9]+" + somewhere +
          R"( is 0\.[23][0-9]* times that on a lattice, outside 0\.333333 to 2: particles have gathered there, )"
          R"(at t = 1e-06 s \(step 1, step size 1e-06 s\)\. )" +
          keep_apart);
}

// The roughest start that a case can ask for.
TEST(Guard, StartsThatSpreadOutByThemselvesPass) {
  for (const char* const kernel : {"quintic", "wendland_c6"}) {
    CaseText text(4.0, 20);
    text.kernel(kernel).flow(0.05).section("particles", "spacing = 0.2\narrangement = \"jittered\"\njitter = 0.5");
    CaseRun run(text);
    EXPECT_EQ(failure(run, 20), "no error") << kernel;
  }
}

TEST(Guard, AVoidIsNamed) {
  CaseRun run(short_steps("double"));
  // All around particle 210, at (2.1, 2.1), go between the others.
  int moved = 0;
  for (int n = 0; n < 400; ++n) {
    const double x = 0.2 * (n % 20) + 0.1;
    const double y = 0.2 * (n / 20) + 0.1;
    if (n == 210 || std::hypot(x - 2.1, y - 2.1) > 0.55) continue;
    put(run, n, 0.2 + 0.4 * (moved % 9), moved / 9 == 0 ? 0.4 : (moved / 9 == 1 ? 3.6 : 0.8));
    ++moved;
  }
  EXPECT_GT(moved, 15);
  expect_matches(
      failure(run, 1),
      R"(the run broke down: the volume of particle 210 \(2\.1[0-9]*, 2\.[01][0-9]*\) is [2-9]\.?[0-9]* times )"
      R"(that on a lattice, outside 0\.333333 to 2: particles have left a void there, at t = 1e-06 s )"
      R"(\(step 1, step size 1e-06 s\)\. )" +
          keep_apart);
}

class PairGuard : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(PairGuard, TwoParticlesAtOnePlaceAreNamedAtTheNextLook) {
  const auto [precision, boundary] = GetParam();
  CaseRun run(short_steps(precision, boundary));
  // On either side of the face, 0.012 m = 0.06 spacings apart.
  put(run, 7, 0.004, 2.0);
  put(run, 9, 3.992, 2.0);
  run.state().step = 126;
  EXPECT_EQ(failure(run, 1), "no error") << "it looks at every 128th step";
  expect_matches(failure(run, 1),
                 R"(the run broke down: particle 7 \(0\.004[0-9]*, 2(\.0[0-9]*)?\) and particle 9 \(3\.99[0-9]*, )"
                 R"(2(\.0[0-9]*)?\) are 0\.0[56][0-9]* spacings apart, less than 0\.1, at t = 2e-06 s )"
                 R"(\(step 128, step size 1e-06 s\)\. )" +
                     keep_apart);
}

INSTANTIATE_TEST_SUITE_P(All, PairGuard,
                         testing::Combine(testing::Values("single", "double"),
                                          testing::Values("periodic_ghosts", "periodic_wrap")),
                         [](const auto& set) {
                           return std::string(std::get<0>(set.param)) + "_" + std::get<1>(set.param);
                         });

TEST(ClosestPair, IsThatOfAllPairs) {
  for (const char* const boundary : {"periodic_ghosts", "periodic_wrap"}) {
    for (int seed = 1; seed <= 10; ++seed) {
      CaseText text = active_scene("double", boundary);
      text.section("particles",
                   "spacing = 0.2\narrangement = \"jittered\"\njitter = 0.45\nseed = " + std::to_string(seed));
      CaseRun run(text);
      const auto x = run.path(0);
      const auto y = run.path(1);
      double closest = HUGE_VAL;
      for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          closest = std::min(closest, std::hypot(std::remainder(x[i] - x[j], 4.0), std::remainder(y[i] - y[j], 4.0)));
      const auto found = closest_pair(run.state(), 0.2);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->distance, closest, 1e-12) << seed;
      const auto id = run.state().particles.id.host();
      const auto a = static_cast<std::size_t>(id[found->a]);
      const auto b = static_cast<std::size_t>(id[found->b]);
      EXPECT_NEAR(std::hypot(std::remainder(x[a] - x[b], 4.0), std::remainder(y[a] - y[b], 4.0)), closest, 1e-12);
      EXPECT_FALSE(closest_pair(run.state(), 0.99 * closest));
    }
  }
}

// The worst that a case may start from.
TEST(Guard, JitteredStartPasses) {
  for (const char* const kernel : {"quintic", "wendland_c2", "wendland_c6"}) {
    CaseText text = active_scene("double");
    text.kernel(kernel).section("particles", "spacing = 0.2\narrangement = \"jittered\"\njitter = 0.5\nseed = 1");
    CaseRun run(text);
    EXPECT_EQ(failure(run, 130), "no error") << kernel;
  }
}

TEST(Guard, WhatIsNotFiniteIsNamedByFieldParticleAndTime) {
  for (const char* const precision : {"single", "double"}) {
    CaseRun run(active_scene(precision).section("time", "end = 1e6\nstep = 0.002"));
    run.run_steps(4);
    Field& q = run.state().fields.at("order_tensor");
    const auto id = run.state().particles.id.host();
    const auto place = static_cast<Index>(std::find(id.begin(), id.end(), 123) - id.begin());
    q.set(1, place, std::numeric_limits<double>::quiet_NaN());
    ++q.version;
    const std::string text = failure(run, 1);
    expect_contains(text, "the run broke down: '");
    expect_contains(text, "' is not finite at particle ");
    expect_contains(text, " at t = 0.01 s (step 5, step size 0.002 s)");
    expect_contains(text,
                    ". Leave the shift of the flow at its default, or take a smaller time.step, or leave it to "
                    "\"auto\"; the frames "
                    "before are kept");
  }
}

// Without a flow nothing can run away; too large a step shows in the order tensor.
TEST(Guard, UnstableRelaxationBreaksDown) {
  CaseText text(4.0, 20);
  text.modes("director", "[[1, 0, 0.4, 0.3]]").nematic(0.4, 0.7, 0.02).section("time", "end = 1e9\nstep = 50.0");
  CaseRun run(text);
  const std::string message = failure(run, 2000);
  expect_contains(message, "the run broke down: 'order_tensor");
  expect_contains(message, "' is not finite at particle ");
}

TEST(Guard, AutomaticStepNeedsNoGuard) {
  CaseRun run(active_scene("single"));
  EXPECT_EQ(failure(run, 200), "no error");
}

}  // namespace
