#include "run/resume_rules.hpp"

#include <gtest/gtest.h>

#include "case_text.hpp"

namespace mesogen {
namespace {

Case case_with(const std::vector<std::string>& changes) {
  Problems problems;
  test::CaseText text(1.0, 10);
  text.flow(0.5).section("time", "end = 2.0").section("output", "interval = 1.0");
  Case result = read_case_text(text.text(), "case.toml", changes, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return result;
}

std::string complaint(const std::vector<std::string>& before, const std::vector<std::string>& after, double time) {
  Problems problems;
  check_resumed_values(case_with(before), case_with(after), {time, 0.01}, problems);
  return problems.text();
}

TEST(ResumeRules, NameTheKeysThatMayChangeAndTheWayForOthers) {
  Problems problems;
  check_resumed_keys({"time.end=3", " output.checkpoint_interval = 5", "title=other", "run.device=auto"}, "runs/a",
                     problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  check_resumed_keys({"time.step=0.1"}, "runs/a", problems);
  EXPECT_NE(problems.text().find("--set: time.step: cannot change while a run goes on"), std::string::npos);
  EXPECT_NE(problems.text().find("`mesogen branch runs/a NEW --set time.step=0.1`"), std::string::npos);
}

TEST(ResumeRules, CompareCasesWithoutTheseKeys) {
  const auto text = [](const std::vector<std::string>& changes) {
    return without_resumable_keys(case_with(changes).resolved_text);
  };
  EXPECT_EQ(text({}), text({"time.end=3", "title=other", "output.checkpoint_times=[1.0]"}));
  EXPECT_NE(text({}), text({"time.step=0.1"}));
  EXPECT_NE(text({}), text({"output.interval=0.5"}));
}

TEST(ResumeRules, LetTheEndAndKeptTimesChangeInTheFutureAlone) {
  EXPECT_EQ(complaint({}, {"time.end=1.5"}, 1.0), "");
  // At the time that the run has come to, or by less than a millionth of its step later, no step would lead to the end.
  for (const char* end : {"time.end=0.9", "time.end=1.0", "time.end=1.000000001"})
    EXPECT_NE(complaint({}, {end}, 1.0).find("time.end: must be later than t = 1 s, since the run has come that far"),
              std::string::npos);
  EXPECT_EQ(complaint({"time.end=1.0"}, {"time.end=1.0"}, 1.0), "");
  const std::string old = "output.checkpoint_times=[0.5, 1.5]";
  EXPECT_EQ(complaint({old}, {"output.checkpoint_times=[0.5, 1.25]"}, 1.0), "");
  for (const char* change : {"output.checkpoint_times=[1.5]", "output.checkpoint_times=[0.5, 0.75]"})
    EXPECT_NE(complaint({old}, {change}, 1.0)
                  .find("output.checkpoint_times: must stay as it was up to t = 1 s, where the "
                        "run is now: [0.5]"),
              std::string::npos);
}

}  // namespace
}  // namespace mesogen
