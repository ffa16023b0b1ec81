// Steps end exactly on the times that something is asked for, and are shortened by little for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "active_scene.hpp"
#include "time/timing.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// The steps that lead to a mark; the time stands on it.
std::vector<double> steps_to(CaseRun& run, double mark) {
  std::vector<double> steps;
  while (run.time() < mark) {
    const Stepper::Step step = run.stepper().next_step(mark);
    steps.push_back(step.seconds);
    run.stepper().advance(step, {});
  }
  EXPECT_EQ(run.time(), mark);
  return steps;
}

CaseText scene(const std::string& step) {
  return CaseText(4.0, 20).modes("velocity", "[[0, 1, 0.1, 0.0]]").flow(0.05).section("time", "end = 10.0\n" + step);
}

// A way of 3.4 steps is gone in four equal ones; none is tiny, and none is longer than what is stable.
TEST(Landing, EqualStepsLeadToAMark) {
  CaseRun run(scene("step = 0.01"));
  const auto steps = steps_to(run, 0.034);
  EXPECT_EQ(steps.size(), 4U);
  for (const double step : steps) EXPECT_NEAR(step, 0.0085, 1e-15);
  EXPECT_EQ(steps_to(run, 0.035).size(), 1U);
}

TEST(Landing, AutomaticStepsAreNeverTiny) {
  CaseRun run(scene(""));
  const double free = run.stepper().next_step(1e6).seconds;
  for (const double mark : {3.3 * free, 10.0 * free, 10.7 * free}) {
    const auto steps = steps_to(run, mark);
    const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
    EXPECT_LE(*most, free * (1.0 + 1e-6));
    EXPECT_GE(*least, 0.69 * free) << mark;
    EXPECT_GE(*least, 0.999 * *most) << mark;
  }
}

// Where marks fall on steps, they leave no trace in the steps, and times are multiples of the step to the last bit.
TEST(Landing, MarksOnStepsChangeNothing) {
  CaseRun few(scene("step = 0.01"));
  CaseRun many(scene("step = 0.01"));
  steps_to(few, 0.3);
  for (int n = 1; n <= 30; ++n) {
    const auto steps = steps_to(many, n == 30 ? 0.3 : rounded_time(0.01 * n));
    EXPECT_EQ(steps, std::vector{0.01});
  }
  EXPECT_EQ(many.state().step, few.state().step);
  EXPECT_EQ(many.path(1), few.path(1));
  EXPECT_EQ(many.field("velocity", 0), few.field("velocity", 0));
}

}  // namespace
