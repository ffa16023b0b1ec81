#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adaptive_sound.hpp"

namespace {

using namespace mesogen;

/// Steps of 0.01 s with this |c|, until the sound, 2 m/s at first, rises; 0: it does not within 10 s. Then its speed.
double seconds_to_rise(wcsph::AdaptiveSound& sound, double compression, double fastest = 0.0) {
  for (int n = 1; n <= 1000; ++n) {
    sound.flows_at(fastest);
    if (sound.softening() < 1.0) sound.rise();
    if (!sound.after_step(compression, 0.01).empty()) return 0.01 * n;
  }
  return 0.0;
}

// A box of 4 m, 2 s of sound across; delta = 0.01.
TEST(AdaptiveSound, RisesWhereTheDensityVariesTooMuchForAWhile) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.01, 4.0, true);
  EXPECT_EQ(seconds_to_rise(sound, 0.029), 0.0);
  EXPECT_EQ(sound.speed(), 2.0);
  sound.start(2.0, 0.01, 4.0, true);
  EXPECT_NEAR(seconds_to_rise(sound, 0.06), 2.0 * std::log(2.0), 0.03);  // 0.06 (1 - exp(-t / 2)) = 0.03
  EXPECT_NEAR(sound.speed(), 2.0 * std::sqrt(3.0), 0.02);
  sound.start(2.0, 0.01, 4.0, true);
  EXPECT_NEAR(seconds_to_rise(sound, 0.12), 0.02, 1e-9);  // at once, to half of 10 delta
  EXPECT_NEAR(sound.speed(), 2.0 * std::sqrt(0.12 / 0.05), 1e-12);
}

// A sound wave of 5 delta that decays within the time it takes through the box.
TEST(AdaptiveSound, StaysWhereSoundComesAndGoes) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.01, 4.0, true);
  for (int n = 0; n < 1000; ++n)
    EXPECT_EQ(sound.after_step(0.05 * std::abs(std::cos(0.02 * n)) * std::exp(-0.005 * n), 0.01), "");
}

// Also where nobody calls after_step() any more, since the case gives the step.
TEST(AdaptiveSound, RisesOnce) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.01, 4.0, true);
  EXPECT_EQ(sound.after_step(0.2, 0.01), "");
  EXPECT_NEAR(sound.softening(), 0.25, 1e-12);
  sound.rise();
  EXPECT_NEAR(sound.speed(), 4.0, 1e-12);
  EXPECT_EQ(sound.softening(), 1.0);
}

TEST(AdaptiveSound, RisesWhereTheFlowIsNearlyAsFast) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.01, 4.0, true);
  EXPECT_EQ(seconds_to_rise(sound, 0.0, 0.99), 0.0);
  EXPECT_NEAR(seconds_to_rise(sound, 0.0, 1.1), 0.02, 1e-9);
  EXPECT_EQ(sound.speed(), 4.4);
}

// The run is stopped at 0.3: a generous density_variation must not wait for that.
TEST(AdaptiveSound, RisesBeforeTheRunIsStopped) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.1, 4.0, true);
  EXPECT_GT(seconds_to_rise(sound, 0.2), 0.0);
  sound.start(2.0, 0.1, 4.0, true);
  EXPECT_NEAR(seconds_to_rise(sound, 0.22), 0.02, 1e-9);
}

TEST(AdaptiveSound, StaysWhereItIsGiven) {
  wcsph::AdaptiveSound sound;
  sound.start(2.0, 0.01, 4.0, false);
  EXPECT_EQ(seconds_to_rise(sound, 0.2, 3.0), 0.0);
  EXPECT_EQ(sound.speed(), 2.0);
  EXPECT_EQ(sound.softening(), 1.0);
}

}  // namespace
