#include "time/kept_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mesogen {
namespace {

TEST(KeptTimes, AreThoseOfTheListAndMultiples) {
  const KeptTimes kept({2.5, 0.7}, 1.0);
  std::vector<double> times;
  for (double time = 0.0; times.size() < 5; time = times.back()) times.push_back(kept.next(time));
  EXPECT_EQ(times, (std::vector<double>{0.7, 1.0, 2.0, 2.5, 3.0}));
}

TEST(KeptTimes, EndWithTheList) {
  const KeptTimes kept({0.7}, {});
  EXPECT_EQ(kept.next(0.0), 0.7);
  EXPECT_TRUE(std::isinf(kept.next(0.7)));
  EXPECT_FALSE(kept.due(0.7, 1e9));
  EXPECT_TRUE(std::isinf(KeptTimes({}, {}).next(0.0)));
}

TEST(KeptTimes, AreCounted) {
  const KeptTimes kept({2.5, 0.7, 3.0, 0.7, 0.1 + 0.2, 0.3, 5.5}, 1.0);
  EXPECT_EQ(kept.count(2.6), 5.0);  // 0.3, 0.7, 1, 2, 2.5
  EXPECT_EQ(kept.count(3.0), 6.0);
  EXPECT_EQ(KeptTimes({}, 0.3).count(1.0), 3.0);
  EXPECT_EQ(KeptTimes({}, {}).count(1.0), 0.0);
}

// Sums of steps come to a time with some rounding, from below or above: it is reached once.
TEST(KeptTimes, AreReachedOnceWhateverTheRounding) {
  const KeptTimes kept({0.3}, 0.1);
  int count = 0;
  double time = 0.0;
  for (int step = 0; step < 100; ++step) {
    const double to = time + 0.01;
    if (kept.due(time, to)) ++count;
    time = to;
  }
  EXPECT_EQ(count, 10);
}

}  // namespace
}  // namespace mesogen
