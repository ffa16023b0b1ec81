#include "time/marks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mesogen {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

struct Walk {
  std::vector<double> steps;            // s
  std::vector<std::vector<double>> at;  // of each reader, the times at which it reads
  std::vector<double> kept;
};

/// A run to `end` with steps that may last `longest`, as far as its times go.
Walk walk(const Marks& marks, std::size_t readers, double end, double longest) {
  Walk walk;
  walk.at.resize(readers);
  Arrival now;
  while (now.time < end) {
    const double mark = marks.next(now, end, longest);
    const EqualSteps cut = equal_steps(mark - now.time, longest);
    const Arrival next{cut.count > 1.0 ? now.time + cut.seconds : mark, cut.seconds};
    walk.steps.push_back(next.time - now.time);
    const auto due = marks.due(now, next, static_cast<std::int64_t>(walk.steps.size()));
    for (std::size_t n = 0; n < readers; ++n)
      if (due[n]) walk.at[n].push_back(next.time);
    if (marks.keeps(now, next)) walk.kept.push_back(next.time);
    now = next;
  }
  return walk;
}

double least(const std::vector<double>& values) {
  double least = forever;
  for (const double value : values) least = std::min(least, value);
  return least;
}

TEST(EqualSteps, AreAsFewAsMayBeAndStayAsTheyAreWhereTheyLeadThere) {
  EXPECT_EQ(equal_steps(0.034, 0.01).count, 4.0);
  EXPECT_DOUBLE_EQ(equal_steps(0.034, 0.01).seconds, 0.0085);
  EXPECT_EQ(equal_steps(0.3, 0.01).count, 30.0);
  EXPECT_EQ(equal_steps(0.3, 0.01).seconds, 0.01);
  EXPECT_EQ(equal_steps(0.001, 0.01).count, 1.0);
  EXPECT_EQ(equal_steps(0.5, forever).count, 1.0);
  EXPECT_EQ(equal_steps(forever, 0.01).seconds, 0.01);
}

// 0.3 s and 0.30000000001 s, 0.6 s and 0.60000000002 s: no step leads from one to the other, and both readers read.
TEST(Marks, ThatAreNearlyEqualAreOne) {
  const Marks marks({Timing{0.1, {}}, Timing{0.30000000001, {}}}, KeptTimes({0.1 + 0.1 + 0.1, 0.3, 0.9}, {}));
  for (const double longest : {0.01, 0.004, 1.0}) {
    const Walk run = walk(marks, 2, 1.2, longest);
    EXPECT_GT(least(run.steps), 0.5 * std::min(longest, 0.1)) << longest;
    EXPECT_EQ(run.at[0].size(), 12U);
    EXPECT_EQ(run.at[1].size(), 4U);
    EXPECT_EQ(run.kept.size(), 2U);
    EXPECT_NEAR(run.at[1].front(), 0.3, 1e-10);
    EXPECT_EQ(run.at[0].back(), 1.2);
  }
}

// Those that are further apart than a millionth of a step stay two.
TEST(Marks, ThatAreFurtherApartAreTwo) {
  const Marks marks({Timing{0.1, {}}, Timing{0.30001, {}}}, KeptTimes({}, {}));
  const Walk run = walk(marks, 2, 0.35, 0.01);
  EXPECT_NEAR(least(run.steps), 1e-5, 1e-10);
  EXPECT_EQ(run.at[1], std::vector{0.30001});
}

TEST(Marks, JustBeforeTheEndMakeWayForIt) {
  const Marks marks({Timing{0.29999999999, {}}}, KeptTimes({0.2999999999}, {}));
  const Walk run = walk(marks, 1, 0.3, 0.01);
  EXPECT_GT(least(run.steps), 0.005);
  EXPECT_EQ(run.at[0], std::vector{0.3});
  EXPECT_EQ(run.kept, std::vector{0.3});
}

// Even where an interval is far shorter than a step, each of its times is one.
TEST(Marks, OfAnIntervalBelowAStepAreAllMet) {
  const Marks marks({Timing{1e-9, {}}}, KeptTimes({}, {}));
  EXPECT_EQ(walk(marks, 1, 1e-7, 1.0).at[0].size(), 100U);
}

TEST(Marks, TellWhetherATimeIsOneOfThem) {
  const Marks marks({Timing{0.1, {}}, Timing{{}, 3}}, KeptTimes({0.25}, 0.7));
  for (const double time : {0.1, 0.25, 0.3, 0.7, 1.4}) EXPECT_TRUE(marks.has(time)) << time;
  for (const double time : {0.05, 0.26, 0.35, 1.41}) EXPECT_FALSE(marks.has(time)) << time;
}

}  // namespace
}  // namespace mesogen
