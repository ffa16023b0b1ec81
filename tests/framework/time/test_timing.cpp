#include "time/timing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace mesogen;

// Sums and products of 0.1 differ in their last bits; the time that they stand for does not.
TEST(RoundedTime, TellsTheTimeThatASumStandsFor) {
  EXPECT_NE(3 * 0.1, 0.3);
  EXPECT_EQ(rounded_time(3 * 0.1), 0.3);
  EXPECT_EQ(rounded_time(0.1 + 0.1 + 0.1), 0.3);
  EXPECT_EQ(rounded_time(0.0), 0.0);
  EXPECT_NEAR(rounded_time(1.0 / 3.0), 1.0 / 3.0, 1e-14);
  EXPECT_EQ(rounded_time(60.0), 60.0);
  EXPECT_EQ(rounded_time(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
}

// From mark to mark, none is left out and none comes twice, however many there are.
TEST(Timing, GoesFromMarkToMark) {
  for (const double interval : {0.1, 0.25, 1.0 / 3.0, 7e-5, 60.0}) {
    const Timing timing{interval, {}};
    double time = 0.0;
    for (std::int64_t k = 1; k <= 20000; ++k) {
      const double next = timing.next(time);
      ASSERT_NEAR(next, static_cast<double>(k) * interval, 1e-12 * next) << interval;
      ASSERT_TRUE(timing.due(time, next, k));
      ASSERT_FALSE(timing.due(time, time + 0.6 * (next - time), k));
      time = next;
    }
  }
}

// A time that falls short of a mark by rounding has reached it.
TEST(Timing, TakesATimeThatIsAMarkButForRoundingForIt) {
  const Timing timing{0.1, {}};
  const double short_of = std::nextafter(0.3, 0.0);
  EXPECT_EQ(timing.next(short_of), 0.4);
  EXPECT_TRUE(timing.due(0.25, short_of, 1));
  EXPECT_FALSE(timing.due(short_of, 0.3, 1));
}

// A third of 10 s, as it is written down: no step of a microsecond at the end.
TEST(Timing, AMarkThatIsTheEndButForTheDigitsOfTheIntervalIsTheEnd) {
  const Timing timing{3.333333, {}};
  EXPECT_EQ(timing.next(6.666666, 10.0), 10.0);
  EXPECT_EQ(timing.next(6.666666), 9.999999);
  EXPECT_EQ(timing.next(3.333333, 10.0), 6.666666);
  EXPECT_TRUE(timing.due(9.9, 10.0, 1));
}

// Beside the start, and the end counts once: 0.3, 0.6, 0.9 and 1 s; 0.1 to 1 s.
TEST(Timing, CountsHowOftenItHappensInARun) {
  EXPECT_EQ((Timing{0.3, {}}.count_in_run(1.0, 100.0)), 4.0);
  EXPECT_EQ((Timing{0.1, {}}.count_in_run(1.0, 100.0)), 10.0);
  EXPECT_EQ((Timing{3.333333, {}}.count_in_run(10.0, 100.0)), 3.0);
  EXPECT_EQ((Timing{1e300, {}}.count_in_run(1.0, 100.0)), 1.0);
  EXPECT_EQ((Timing{1e-9, {}}.count_in_run(1.0, 100.0)), 1e9);
  EXPECT_EQ((Timing{{}, 10}.count_in_run(1.0, 100.0)), 10.0);
  EXPECT_EQ((Timing{{}, 10}.count_in_run(1.0, 101.0)), 11.0);
  EXPECT_EQ((Timing{}.count_in_run(1.0, 100.0)), 1.0);
  EXPECT_EQ((Timing{0.3, {}}.count(1.0)), 3.0);
  EXPECT_EQ((Timing{{}, 10}.count(1.0)), 0.0);
}

TEST(Timing, OfStepsAsksForNoTime) {
  const Timing timing{{}, 3};
  EXPECT_EQ(timing.next(0.5), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(timing.due(0.0, 10.0, 4));
  EXPECT_TRUE(timing.due(0.0, 0.1, 6));
  EXPECT_EQ((Timing{}.next(0.5)), std::numeric_limits<double>::infinity());
  EXPECT_FALSE((Timing{}.due(0.0, 10.0, 3)));
}

}  // namespace
