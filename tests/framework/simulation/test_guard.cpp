// A run that breaks down says where, and what to do.

#include <gtest/gtest.h>

#include <limits>

#include "active_scene.hpp"

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

TEST(Guard, AbsurdStepRunsAway) {
  CaseRun run(active_scene("double").section("time", "end = 1e6\nstep = 0.4"));
  const std::string text = failure(run, 20);
  expect_contains(text, "the run ran away: the largest speed of ");
  expect_contains(text, " m/s carries a particle over 0.5 spacings in one step at t = 0.4 s (step 1, step size 0.4 s)");
  expect_contains(text, "Take a smaller time.step, or leave it to \"auto\"; the frames before are kept");
}

TEST(Guard, WhatIsNotFiniteIsNamedByFieldParticleAndTime) {
  for (const char* const precision : {"single", "double"}) {
    CaseRun run(active_scene(precision).section("time", "end = 1e6\nstep = 0.002"));
    run.run_steps(4);
    Field& q = run.world().fields.at("order_tensor");
    const auto& id = run.world().particles.id;
    const auto place = static_cast<Index>(std::find(id.begin(), id.end(), 123) - id.begin());
    q.set(1, place, std::numeric_limits<double>::quiet_NaN());
    ++q.version;
    const std::string text = failure(run, 1);
    expect_contains(text, "the run broke down: '");
    expect_contains(text, "' is not finite at particle ");
    expect_contains(text, " at t = 0.01 s (step 5, step size 0.002 s)");
    expect_contains(text,
                    "Take a smaller step (time.factor = 0.5, or time.step), more particles, or a smaller "
                    "activity; the frames before are kept");
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
