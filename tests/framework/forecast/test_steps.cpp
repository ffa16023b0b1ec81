// How many steps a run takes: those that are cut to end on the times asked for are counted as such.

#include "forecast/steps.hpp"

#include <gtest/gtest.h>

#include "case_run.hpp"

namespace mesogen::test {
namespace {

CaseText fluid(const std::string& time, const std::string& output) {
  CaseText text(4.0, 10);
  return text.flow(0.5).section("time", time).section("output", output);
}

StepForecast steps_of(const std::string& time, const std::string& output) {
  CaseRun run = CaseRun::unstarted(fluid(time, output));
  return forecast_steps(run.setup());
}

TEST(StepForecast, CountsStepsThatAreCutToTheTimesAskedFor) {
  const std::string time = "end = 1.0\nstep = 0.01";
  EXPECT_EQ(steps_of(time, "").expected, 100.0);
  EXPECT_EQ(steps_of(time, "interval = 0.1").expected, 100.0);
  EXPECT_EQ(steps_of(time, "interval = 0.005").expected, 200.0);
  // 3 steps to each multiple of 0.025 s, and 40 of these.
  EXPECT_EQ(steps_of(time, "interval = 0.025").expected, 120.0);
  EXPECT_EQ(steps_of(time, "checkpoint_every = 0.025").expected, 120.0);
  EXPECT_EQ(steps_of(time, "checkpoint_times = [0.505]").expected, 101.0);
  EXPECT_EQ(steps_of(time, "interval = 0.3\ncheckpoint_every = 0.30000000001").expected, 100.0);
}

TEST(StepForecast, CountsBeyondWhatItWalksThrough) {
  EXPECT_EQ(steps_of("end = 1.0\nstep = 0.01", "interval = 1e-7").expected, 1e7);
  EXPECT_EQ(steps_of("end = 1.0\nstep = 0.01", "interval = 1e-12").expected, 1e12);
}

TEST(StepForecast, CountsReadersAtTheEndOnce) {
  CaseText text = fluid("end = 10.0\nstep = 0.01", "interval = 3.333333");
  text.section("observers.steps", "type = \"flow_statistics\"\nevery = 100");
  text.section("observers.times", "type = \"flow_statistics\"\ninterval = 4.0");
  text.section("observers.end", "type = \"flow_statistics\"");
  CaseRun run = CaseRun::unstarted(text);
  EXPECT_EQ(times_due(run.setup(), 0, 1000.0), 10.0);
  EXPECT_EQ(times_due(run.setup(), 0, 1001.0), 11.0);
  EXPECT_EQ(times_due(run.setup(), 1, 1000.0), 3.0);
  EXPECT_EQ(times_due(run.setup(), 2, 1000.0), 1.0);
  EXPECT_EQ(frames_stored(run.setup()), 4.0);
}

TEST(StepForecast, CountsCheckpointsThatStay) {
  const auto checkpoints = [](const std::string& output) {
    CaseRun run = CaseRun::unstarted(fluid("end = 10.0\nstep = 0.01", output));
    return std::pair(checkpoints_kept(run.setup()), checkpoints_stored(run.setup()));
  };
  EXPECT_EQ(checkpoints(""), std::pair(0.0, 2.0));
  // The end is no time asked for: the state before the steps that it shortens stays too.
  EXPECT_EQ(checkpoints("interval = 3.0"), std::pair(0.0, 3.0));
  EXPECT_EQ(checkpoints("checkpoint_every = 3.0"), std::pair(3.0, 5.0));
  EXPECT_EQ(checkpoints("checkpoint_every = 2.5\ncheckpoint_times = [0.5, 5.0, 7.0, 7.0, 11.0]"), std::pair(6.0, 8.0));
}

}  // namespace
}  // namespace mesogen::test
