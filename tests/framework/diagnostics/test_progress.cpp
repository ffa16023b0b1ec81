#include "diagnostics/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace mesogen {
namespace {

/// A run of `steps` steps of 0.01 s that take `pace` seconds of wall time each.
std::string told(Progress::Style style, int steps, double pace) {
  std::ostringstream out;
  double now = 100.0;
  Progress progress(out, style, [&] { return now; });
  progress.start(0.0, 0, steps * 0.01);
  for (int step = 1; step <= steps; ++step) {
    now += pace;
    progress.update(step * 0.01, step);
  }
  progress.finish(steps * 0.01, steps);
  return out.str();
}

std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Progress, WritesATenthAtATimeWhereThereIsNoTerminal) {
  const auto text = told(Progress::Style::plain, 1000, 0.1);
  EXPECT_EQ(lines(text), 11) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_NE(text.find(" 50 %  t = 5 of 10 s  10 steps/s  50 s left\n"), std::string::npos) << text;
  EXPECT_NE(text.find("100 %  t = 10 of 10 s  1000 steps in 1 min 40 s  10 steps/s\n"), std::string::npos) << text;
}

TEST(Progress, WritesSeldomInAShortRun) {
  EXPECT_LE(lines(told(Progress::Style::plain, 1000, 0.005)), 3);  // 5 s: at most one line in 2 s, and the last
  EXPECT_EQ(lines(told(Progress::Style::plain, 10, 0.001)), 1);
}

TEST(Progress, RewritesOneLineOnATerminal) {
  const auto text = told(Progress::Style::terminal, 1000, 0.01);
  EXPECT_EQ(lines(text), 1);
  EXPECT_EQ(text.back(), '\n');
  const auto rewrites = std::count(text.begin(), text.end(), '\r');
  EXPECT_GT(rewrites, 50);
  EXPECT_LE(rewrites, 101);
  EXPECT_NE(text.find("\r\033[K 75 %  t = "), std::string::npos);
  EXPECT_NE(text.find("100 steps/s  2 s left"), std::string::npos) << text;
}

TEST(Progress, IsSilentWhenAsked) { EXPECT_EQ(told(Progress::Style::silent, 1000, 0.1), ""); }

TEST(Progress, CountsFromWhereARunIsResumed) {
  std::ostringstream out;
  double now = 0.0;
  Progress progress(out, Progress::Style::plain, [&] { return now; });
  progress.start(5.0, 500, 10.0);
  for (int step = 501; step <= 750; ++step) {
    now += 0.1;
    progress.update(step * 0.01, step);
  }
  EXPECT_NE(out.str().find(" 75 %  t = 7.5 of 10 s  10 steps/s  25 s left\n"), std::string::npos) << out.str();
  progress.finish(7.5, 750);
  EXPECT_NE(out.str().find(" 75 %  t = 7.5 of 10 s  250 steps in 25 s  10 steps/s\n"), std::string::npos) << out.str();
}

TEST(Progress, ChoosesItsStyle) {
  EXPECT_EQ(Progress::style_for(1, true), Progress::Style::silent);
  EXPECT_EQ(Progress::style_for(-1, false), Progress::Style::plain);
}

TEST(DurationText, HasTwoUnitsAtMost) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(252.0), "4 min 12 s");
  EXPECT_EQ(duration_text(3 * 3600 + 5 * 60 + 20), "3 h 05 min");
  EXPECT_EQ(duration_text(-1.0), "0 s");
  EXPECT_EQ(duration_text(1e300), "very long");
}

}  // namespace
}  // namespace mesogen
