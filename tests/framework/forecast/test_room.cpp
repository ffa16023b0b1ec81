// What of a run is more than a machine has.

#include "forecast/room.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "case_run.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {
namespace {

constexpr double program = 2e7;  // bytes

CaseText fluid(int across) {
  CaseText text(10.0, across);
  text.flow(0.5).precision("single").section("time", "end = 1.0\nstep = 0.001\nstepping = \"explicit\"");
  return text;
}

SetUpWith with_settings(const CaseText& text) {
  return [text](const std::vector<std::string>& settings) {
    Problems problems;
    return set_up(read_case_text(text.text(), "test.toml", settings, problems), built_plugins(), problems);
  };
}

TEST(Room, OfMemoryIsFilledByTheSpacingThatFits) {
  const CaseText text = fluid(200);
  CaseRun run = CaseRun::unstarted(text);
  const double needed = forecast_memory(run.setup(), program).peak();
  for (const double share : {0.9, 0.6}) {
    const auto fits = fitting(run.setup().source, share * needed, program, with_settings(text));
    ASSERT_TRUE(fits);
    EXPECT_GT(fits->spacing, run.setup().scene.spacing);
    CaseRun coarse(text, {"particles.spacing=" + std::to_string(fits->spacing)});
    const double taken = forecast_memory(coarse.setup(), program).peak();
    EXPECT_LT(taken, share * needed);
    EXPECT_GT(taken, 0.8 * share * needed);
  }
  EXPECT_FALSE(fitting(run.setup().source, program, program, with_settings(text)));
}

TEST(Room, OfMemoryThatIsTooLittleIsToldWithWhatFits) {
  const CaseText text = fluid(200);
  CaseRun run = CaseRun::unstarted(text);
  const MemoryForecast memory = forecast_memory(run.setup(), program);
  Problems none;
  refuse_beyond_memory(run.setup(), memory, 1.01 * memory.peak(), program, with_settings(text), none);
  refuse_beyond_memory(run.setup(), memory, 0.0, program, with_settings(text), none);  // not known
  EXPECT_TRUE(none.empty()) << none.text();
  Problems problems;
  refuse_beyond_memory(run.setup(), memory, 0.9 * memory.peak(), program, with_settings(text), problems);
  EXPECT_EQ(problems.text().find("test.toml:"), 0U) << problems.text();
  EXPECT_NE(problems.text().find("particles.spacing: 40000 particles need "), std::string::npos) << problems.text();
  EXPECT_NE(problems.text().find(" particles fit, with a spacing of "), std::string::npos) << problems.text();
}

TEST(Room, StepsAreCountedBeyondAllIntegers) {
  const auto told = [](const std::string& time) {
    CaseText text = fluid(20);
    text.section("time", time);
    CaseRun run = CaseRun::unstarted(text);
    return beyond_steps(run.setup(), forecast_steps(run.setup()));
  };
  EXPECT_EQ(told("end = 1.0\nstep = 1e-9"), "");
  EXPECT_EQ(told("end = 1.0\nstep = 1e-10"),
            "to 1 s in steps of 1e-10 s (limit: time.step of the case) a run takes 1e+10 steps");
  EXPECT_EQ(told("end = 1.0\nstep = 1e-300"),
            "to 1 s in steps of 1e-300 s (limit: time.step of the case) a run takes 1e+300 steps, and time would stand "
            "still before its end");
  EXPECT_EQ(
      told("end = 1e300\nstep = 1e-300"),
      "to 1e+300 s in steps of 1e-300 s (limit: time.step of the case) a run takes more than 1e308 steps, and time "
      "would stand still before its end");
}

TEST(Room, StepsThatAreCutToTheTimesAskedForAreCounted) {
  CaseText text = fluid(20);
  text.section("output", "interval = 1e-11").section("units", "time = \"ms\"");
  CaseRun run = CaseRun::unstarted(text);
  EXPECT_EQ(beyond_steps(run.setup(), forecast_steps(run.setup())),
            "to 1 ms in steps of 1e-11 ms (limit: the times that samples, frames and checkpoints are asked for) a run "
            "takes 1e+11 steps");
}

}  // namespace
}  // namespace mesogen::test
