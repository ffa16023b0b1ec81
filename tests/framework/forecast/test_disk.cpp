// What a run takes of a disk, and what fits one that is too small.

#include "forecast/disk.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "case_run.hpp"
#include "forecast/memory.hpp"

namespace mesogen::test {
namespace {

CaseText fluid(const std::string& output) {
  CaseText text(10.0, 20);
  return text.flow(0.5).precision("single").section("time", "end = 1.0\nstep = 0.001").section("output", output);
}

std::string told(const std::string& output, double free) {
  CaseRun run = CaseRun::unstarted(fluid(output));
  const auto excess = beyond_disk(run.setup(), free);
  return excess ? excess->key + ": " + excess->text : "";
}

std::string number_in(const std::string& text, const std::string& pattern) {
  std::smatch found;
  EXPECT_TRUE(std::regex_search(text, found, std::regex(pattern))) << text;
  return found.empty() ? "1" : found[1].str();
}

TEST(Disk, HoldsFramesTwice) {
  CaseRun run = CaseRun::unstarted(fluid("interval = 0.1"));
  const double needed = most_on_disk(run.setup());
  EXPECT_DOUBLE_EQ(needed, 2.0 * 11.0 * frame_bytes(run.setup()) + 2.0 * checkpoint_bytes(run.setup()));
  EXPECT_FALSE(beyond_disk(run.setup(), needed));
  EXPECT_FALSE(beyond_disk(run.setup(), 0.0));
  const std::string text = told("interval = 0.1", 0.9 * needed);
  EXPECT_NE(text.find("output.interval: 11 frames of "), std::string::npos) << text;
  EXPECT_NE(text.find(" MB and 2 checkpoints of "), std::string::npos) << text;
  const std::string interval = number_in(text, "an interval of (\\S+) s or more fits");
  EXPECT_EQ(told("interval = " + interval, 0.9 * needed), "");
  EXPECT_NE(told("interval = 0.1", 10.0).find("; make room, or take fewer particles or fields"), std::string::npos);
}

TEST(Disk, HoldsCheckpointsThatAreKept) {
  const std::string output = "interval = 0.5\ncheckpoint_every = 0.01";
  CaseRun run = CaseRun::unstarted(fluid(output));
  const double needed = most_on_disk(run.setup());
  EXPECT_DOUBLE_EQ(needed, 2.0 * 3.0 * frame_bytes(run.setup()) + 102.0 * checkpoint_bytes(run.setup()));
  EXPECT_DOUBLE_EQ(bytes_on_disk(run.setup()), 3.0 * frame_bytes(run.setup()) + 102.0 * checkpoint_bytes(run.setup()));
  const std::string text = told(output, needed / 2.0);
  EXPECT_NE(text.find("output.checkpoint_every: 3 frames of "), std::string::npos) << text;
  EXPECT_NE(text.find(" MB and 102 checkpoints of "), std::string::npos) << text;
  const std::string every = number_in(text, "output\\.checkpoint_every = (\\S+) or more fits");
  EXPECT_LT(std::stod(every), 0.03);
  EXPECT_EQ(told("interval = 0.5\ncheckpoint_every = " + every, needed / 2.0), "");
}

TEST(Disk, TellsHowManyCheckpointsOfAListFit) {
  const std::string text = [&] {
    CaseRun run = CaseRun::unstarted(fluid("checkpoint_times = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]"));
    return told("checkpoint_times = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]", 0.8 * most_on_disk(run.setup()));
  }();
  EXPECT_EQ(text.find("output.checkpoint_times: "), 0U) << text;
  EXPECT_NE(text.find("; no more than "), std::string::npos) << text;
  EXPECT_NE(text.find(" checkpoints kept for good fit"), std::string::npos) << text;
}

}  // namespace
}  // namespace mesogen::test
