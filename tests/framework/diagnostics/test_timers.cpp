#include "diagnostics/timers.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace mesogen {
namespace {

TEST(Timers, SumByName) {
  Timers timers;
  timers.add("sort", 0.25);
  timers.add("pressure", 1.5);
  timers.add("sort", 0.25);
  EXPECT_EQ(timers.totals().at("sort").seconds, 0.5);
  EXPECT_EQ(timers.totals().at("sort").count, 2);
  EXPECT_EQ(timers.totals().size(), 2U);
}

TEST(Timers, MeasureAScope) {
  Timers timers;
  for (int n = 0; n < 2; ++n) {
    const auto timed = timers.measure("sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(timers.totals().at("sleep").count, 2);
  EXPECT_GE(timers.totals().at("sleep").seconds, 0.01);
}

TEST(Timers, TellTheLongestFirst) {
  Timers timers;
  timers.add("sort", 0.5);
  timers.add("pressure", 1.0);
  timers.add("pressure", 0.5);
  EXPECT_EQ(timers.text(4.0),
            "pressure      1.500 s   37.5 %         2 x    750.0000 ms\n"
            "sort          0.500 s   12.5 %         1 x    500.0000 ms\n");
  timers.clear();
  EXPECT_EQ(timers.text(4.0), "");
}

}  // namespace
}  // namespace mesogen
