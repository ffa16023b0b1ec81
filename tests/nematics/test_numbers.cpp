// The numbers of a scene, against the paper's own and values computed by hand.

#include "forecast/advice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case_text.hpp"
#include "run/setup.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;
using Numbers = std::map<std::string, double>;

Numbers numbers_of(const CaseText& text) {
  Problems problems;
  const auto setup = set_up(read_case_text(text.text(), "test.toml", {}, problems), built_plugins(), problems);
  Numbers numbers;
  for (const SceneNumber& number : scene_numbers(*setup)) {
    EXPECT_FALSE(number.unit.empty());
    EXPECT_FALSE(number.meaning.empty());
    EXPECT_TRUE(numbers.emplace(number.name, number.value).second) << number.name << " twice";
  }
  return numbers;
}

/// Table 2 of the paper; across = 500 there.
CaseText paper(int across = 100) {
  CaseText text(10.0, across);
  text.section("director", "type = \"uniform\"").flow(2.0 / 3.0).nematic(0.4, 0.7, 0.02).active(0.023);
  return text;
}

TEST(DimensionlessNumbers, OfThePaperAreItsOwn) {
  const Numbers found = numbers_of(paper(500));
  EXPECT_NEAR(found.at("active_length"), 0.93, 0.005);
  EXPECT_NEAR(found.at("paper_speed"), 0.054, 0.0005);
  EXPECT_NEAR(found.at("reynolds_active"), 0.075, 0.0005);
  EXPECT_NEAR(found.at("core_size"), 0.141, 0.0005);
  EXPECT_NEAR(found.at("core_size_in_spacings"), 7.07, 0.005);
  EXPECT_NEAR(found.at("active_length_in_spacings"), 46.6, 0.05);
  EXPECT_NEAR(found.at("box_in_active_lengths"), 10.72, 0.005);
  EXPECT_NEAR(found.at("inertial_time"), 3.80, 0.005);
}

// The second wave, of 5 m, is the fastest: its matrix ((-0.0126331, 0.675), (0.157914, -1.052758)) has the eigenvalue
// 0.0813539 1/s. l_Q = 0.63246 m.
TEST(DimensionlessNumbers, OfTheBenchmark) {
  const Numbers found = numbers_of(paper().active(0.05));
  EXPECT_NEAR(found.at("growth_rate"), 0.0813539, 1e-7);
  EXPECT_NEAR(found.at("growth_time"), 12.292, 0.001);
  EXPECT_NEAR(found.at("growth_wave_length"), 5.0, 1e-9);
  EXPECT_NEAR(found.at("waves_in_box"), 2.0, 1e-9);
  EXPECT_NEAR(found.at("growth_rate_without_inertia"), 0.0886169, 1e-7);
  EXPECT_NEAR(found.at("inertia"), 3.7995 / 12.292, 1e-4);
  EXPECT_NEAR(found.at("active_speed"), 0.05 * 0.632456 / (2.0 / 3.0), 1e-6);
}

TEST(DimensionlessNumbers, OfAPlainFluid) {
  CaseText text(2.0, 20);
  text.flow(0.1, "expected_speed = 0.5\nsound_speed = 25.0");
  EXPECT_EQ(numbers_of(text).size(), 4U);
  const Numbers found = numbers_of(text);
  EXPECT_DOUBLE_EQ(found.at("speed"), 0.5);
  EXPECT_DOUBLE_EQ(found.at("reynolds_box"), 1.0 * 0.5 * 2.0 / 0.1);
  EXPECT_DOUBLE_EQ(found.at("mach"), 0.5 / 25.0);
  EXPECT_NEAR(found.at("inertial_time"), 4.0 / (39.4784176 * 0.1), 1e-8);
}

TEST(DimensionlessNumbers, EricksenComparesViscosityWithElasticity) {
  const Numbers found = numbers_of(paper().flow(0.5, "expected_speed = 0.08"));
  EXPECT_DOUBLE_EQ(found.at("ericksen"), 0.5 * 0.08 * 10.0 / 0.02);
}

TEST(DimensionlessNumbers, WithoutFlowOnlyTheNematicHasSome) {
  CaseText text(2.0, 20);
  text.section("director", "type = \"uniform\"").nematic(0.4, 0.7, 0.02);
  const Numbers found = numbers_of(text);
  EXPECT_EQ(found.size(), 2U);
  EXPECT_TRUE(found.contains("core_size"));
}

TEST(DimensionlessNumbers, BelowTheThresholdNothingGrows) {
  const Numbers found = numbers_of(paper().active(0.001));
  EXPECT_LT(found.at("growth_rate"), 0.0);
  EXPECT_FALSE(found.contains("growth_time"));
}

// Waves of the box are those of a periodic one.
TEST(DimensionlessNumbers, BetweenWallsNoWavesAreCounted) {
  const Numbers found =
      numbers_of(paper(50).section("domain", "size = [10.0, 10.0]\nboundary = { type = \"walls\", axes = [\"y\"] }"));
  EXPECT_FALSE(found.contains("growth_rate"));
  EXPECT_TRUE(found.contains("active_length"));
}

// What is told of a creeping flow is the fluid's own; how it is computed has a line of its own, and limits of others go
// by it, whichever section comes first.
TEST(DimensionlessNumbers, OfACreepingFlow) {
  CaseText text(10.0, 50);
  text.section("physics.a_substrate", "type = \"friction\"\ncoefficient = 0.01")
      .section("director", "type = \"uniform\"")
      .flow(2.0 / 3.0, "inertia = false")
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .section("time", "end = 1.0\nstepping = \"explicit\"");
  const Numbers found = numbers_of(text);
  const double k2 = 0.394784176;  // (2 pi / 10 m)^2
  const double artificial = std::pow(2.0 / 3.0 * k2 + 0.01, 2) / (0.05 * 1.35 * k2) / 20.0;
  EXPECT_NEAR(found.at("artificial_density") / artificial, 1.0, 1e-6);
  EXPECT_NEAR(found.at("inertial_time"), 1.0 / (k2 * 2.0 / 3.0), 1e-6);
  EXPECT_NEAR(found.at("reynolds_box"), found.at("active_speed") * 10.0 / (2.0 / 3.0), 1e-9);
  EXPECT_GT(found.at("growth_rate"), 0.95 * found.at("growth_rate_without_inertia"));

  Problems problems;
  const auto setup = set_up(read_case_text(text.text(), "test.toml", {}, problems), built_plugins(), problems);
  int limits = 0;
  for (const auto& limit : setup->limits.all()) {
    if (limit.cause != StepCause::friction) continue;
    EXPECT_NEAR(limit.seconds / (0.25 * artificial / 0.01), 1.0, 1e-6);
    ++limits;
  }
  EXPECT_EQ(limits, 1);
}

}  // namespace
