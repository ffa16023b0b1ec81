// Advice about the resolution of defects, about activity and output: each is followed, and does what it promises.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "followed.hpp"
#include "run/run.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

const double core = std::sqrt(0.02);  // xi, m
const double length = 20.0 * core;

/// Four defects, two of each kind, that hold each other in place.
CaseText defects(int across) {
  CaseText text(length, across);
  const double a = length / 4.0;
  const double b = 3.0 * a;
  text.boundary("periodic_wrap")
      .section("director", fmt::format("type = \"defects\"\ncore = {0:.6g}\n"
                                       "defects = [[{1:.12g}, {1:.12g}, 0.5], [{2:.12g}, {2:.12g}, 0.5], "
                                       "[{2:.12g}, {1:.12g}, -0.5], [{1:.12g}, {2:.12g}, -0.5]]",
                                       core, a, b))
      .nematic(0.4, 0.7, 0.02);
  return text;
}

/// Order of a defect at a distance r (in cores): f'' + f'/r - f/r^2 + f - f^3 = 0, f(0) = 0, f(infinity) = 1, so that
/// f'(0) = 0.58319.
double order_at(double r) {
  constexpr double step = 2e-3;
  double x = step;
  double f = 0.5831895 * x;
  double slope = 0.5831895;
  const auto bend = [](double at, double value, double rise) {
    return -rise / at + value / (at * at) - value + value * value * value;
  };
  for (; x < r; x += step) {
    const double middle = slope + step / 2.0 * bend(x, f, slope);
    slope += step * bend(x + step / 2.0, f + step / 2.0 * slope, middle);
    f += step * middle;
  }
  return r < step ? 0.5831895 * r : f + (r - x) * slope;
}

/// Root of the mean square error of the order within 2.5 cores of the defects.
double error_of_cores(CaseRun& run) {
  const auto x = run.path(0);
  const auto y = run.path(1);
  const auto q11 = run.field("order_tensor", 0);
  const auto q12 = run.field("order_tensor", 1);
  double sum = 0.0;
  int count = 0;
  for (const double cx : {length / 4.0, 3.0 * length / 4.0})
    for (const double cy : {length / 4.0, 3.0 * length / 4.0})
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double r = std::hypot(x[i] - cx, y[i] - cy) / core;
        if (r >= 2.5) continue;
        sum += std::pow(std::hypot(q11[i], q12[i]) - order_at(r), 2);
        ++count;
      }
  return std::sqrt(sum / count);
}

TEST(Advice, ProfileOfACoreIsTheKnownOne) {
  EXPECT_NEAR(order_at(0.5), 0.2828, 2e-4);
  EXPECT_NEAR(order_at(1.0), 0.5201, 2e-4);
  EXPECT_NEAR(order_at(2.0), 0.8050, 2e-4);
}

TEST(Advice, MoreParticlesInACoreMakeItRight) {
  const CaseText text = defects(26);
  const auto found = advised(text, "core_under_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding,
            "the core of a defect, xi, is only 1.3 spacings: the order in cores is wrong by some 3.9 %");
  EXPECT_EQ(found->gain, "the order in cores is wrong by some 1.7 %");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(15.0);
  EXPECT_NEAR(error_of_cores(before), 0.040, 0.008);
  EXPECT_NEAR(error_of_cores(after), 0.0165, 0.003);
  expect_settled(text, *found);
}

TEST(Advice, TellsWhatACoarseCoreCostsWhereElasticityActsOnTheFlow) {
  CaseText text = defects(26);
  text.flow(0.2).section("physics.elasticity", "type = \"elastic_stress\"");
  const auto found = advised(text, "core_under_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding,
            "the core of a defect, xi, is only 1.3 spacings: the order in cores is wrong by some 3.9 %, and the energy "
            "of a passive nematic may rise");
}

// Below two spacings it is always told, and a spacing is named that fits both edges of the box.
TEST(Advice, ACoreBelowTwoSpacingsIsNeverPassedInSilence) {
  EXPECT_FALSE(advised(defects(40), "core_under_resolved"));
  for (const int across : {39, 31, 30}) {
    const auto found = advised(defects(across), "core_under_resolved");
    ASSERT_TRUE(found) << across;
    EXPECT_EQ(found->settings.front(), fmt::format("particles.spacing={:.12g}", length / 40));
    expect_settled(defects(across), *found);
  }
  CaseText oblong(3.2, 32);
  oblong.section("domain", "size = [3.2, 1.4]\nboundary = \"periodic_wrap\"")
      .section("director", "type = \"uniform\"")
      .nematic(0.4, 0.7, 0.02);
  const auto found = advised(oblong, "core_under_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings.front(), fmt::format("particles.spacing={:.12g}", 3.2 / 46));  // 20.1 rows
  expect_settled(oblong, *found);
}

// Where a spacing that small is out of reach, the core is told all the same.
TEST(Advice, ACoreThatNoSpacingResolvesIsTold) {
  CaseText text(length, 40);
  text.section("director", "type = \"uniform\"").nematic(0.4, 0.7, 1e-9);
  CaseRun run = CaseRun::unstarted(text);
  const auto all = advice({run.setup(), forecast_steps(run.setup()), 0.0});
  const auto found =
      std::find_if(all.begin(), all.end(), [](const Suggestion& one) { return one.name == "core_under_resolved"; });
  ASSERT_NE(found, all.end());
  EXPECT_TRUE(found->settings.empty());
  EXPECT_NE(found->finding.find("is only 0.00045 spacings"), std::string::npos) << found->finding;
  EXPECT_EQ(found->gain,
            "cores of 2 spacings need 3.2e+10 particles; instead, choose a smaller box or a larger elastic constant");
}

TEST(Advice, FewerParticlesInACoreAreEnough) {
  const CaseText text = defects(90);
  const auto found = advised(text, "core_over_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->gain, "the order in cores is wrong by some 1.7 % instead of 0.33 %, with 5.1 times fewer particles");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(15.0);
  EXPECT_NEAR(static_cast<double>(before.state().particles.count()) / after.state().particles.count(), 5.1, 0.1);
  EXPECT_LE(after.state().step, before.state().step);
  EXPECT_NEAR(error_of_cores(before), 0.0033, 0.001);
  EXPECT_NEAR(error_of_cores(after), 0.0165, 0.003);
  expect_settled(text, *found);
}

TEST(Advice, AboveTheThresholdWavesGrow) {
  CaseText text(1.0, 20);
  text.modes("director", "[[1, 0, 0.01, 0.0]]").flow(0.1).nematic(1.0, 0.7, 0.02).active(0.03);
  const auto found = advised(text, "nothing_grows");
  ASSERT_TRUE(found);
  // zeta = 2 mu Gamma K k^2 / (2 + lambda)
  const double threshold = 2.0 * 0.1 * 0.02 * std::pow(2.0 * std::numbers::pi, 2) / 2.7;
  EXPECT_NE(found->finding.find(fmt::format("below the threshold of {:.3g} Pa", threshold)), std::string::npos)
      << found->finding;
  CaseRun before(text);
  CaseRun after(text, found->settings);
  const auto growth = [](CaseRun& run) {
    const double first = wave_of(run, run.field("order_tensor", 1), 1, 0).cosine;
    run.run_to(1.5);
    return wave_of(run, run.field("order_tensor", 1), 1, 0).cosine / first;
  };
  EXPECT_LT(growth(before), 0.9);
  EXPECT_GT(growth(after), 1.1);
  expect_settled(text, *found);
}

CaseText disordered(double activity, const char* bulk) {
  CaseText text(1.0, 20);
  text.modes("director", "[[1, 0, 0.01, 0.0]]")
      .flow(0.1)
      .section("physics.nematic", fmt::format("type = \"beris_edwards\"\nrotational_diffusivity = 1.0\n"
                                              "flow_alignment = 0.7\nelastic_constant = 0.02\nbulk = {}",
                                              bulk))
      .active(activity);
  return text;
}

TEST(Advice, BelowZeroInBulkOrderLasts) {
  const CaseText text = disordered(0.03, "{ A = 1.0, C = 0.5 }");
  const auto found = advised(text, "no_order");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding,
            "physics.nematic.bulk.A is 1 Pa, not below 0: the order decays, so the activity has nothing to act on");
  EXPECT_EQ(found->settings, std::vector<std::string>{"physics.nematic.bulk.A=-1"});
  EXPECT_EQ(found->gain, "the nematic keeps an order of 1");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(3.0);
  EXPECT_LT(std::abs(before.field("order_tensor", 0).front()), 0.1);
  EXPECT_NEAR(after.field("order_tensor", 0).front(), 1.0, 0.01);
  expect_settled(text, *found);
}

TEST(Advice, WithoutAFourthOrderBothBulkCoefficientsAreGiven) {
  const CaseText text = disordered(0.03, "{ A = 0.4, C = 0.0 }");
  const auto found = advised(text, "no_order");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings, (std::vector<std::string>{"physics.nematic.bulk.A=-0.4", "physics.nematic.bulk.C=0.2"}));
  expect_settled(text, *found);
}

TEST(Advice, DisorderIsLeftWhereItIsMeantOrActivityOrders) {
  EXPECT_FALSE(advised(disordered(0.0, "{ A = 1.0, C = 0.5 }"), "no_order"));
  // lambda zeta / (2 mu) = 3.5 / s, where the longest wave decays by 1.8 / s
  const CaseText strong = disordered(1.0, "{ A = 1.0, C = 0.5 }");
  EXPECT_FALSE(advised(strong, "no_order"));
  CaseRun run(strong, {"director.order=0.01"});
  const auto largest = [](CaseRun& of) {
    double most = 0.0;
    for (const int n : {0, 1})
      for (const double q : of.field("order_tensor", n)) most = std::max(most, std::abs(q));
    return most;
  };
  run.run_to(12.0);
  EXPECT_GT(largest(run), 0.1);
}

// Where there is no order there are no defects.
TEST(Advice, CoresMatterOnlyWhereThereIsOrder) {
  for (const char* name : {"core_under_resolved", "core_over_resolved"})
    for (const char* bulk : {"{ A = 20.0, C = 10.0 }", "{ A = 0.01, C = 0.5 }"})
      EXPECT_FALSE(advised(disordered(0.005, bulk), name)) << name << bulk;
}

TEST(Advice, FewerFramesTakeFewerBytes) {
  CaseText text = defects(30);
  text.section("time", "end = 10.0\nstep = 0.2").section("output", "interval = 0.2");
  const auto found = advised(text, "large_output", 1e6);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->gain, "4 frames, 13 times fewer bytes");
  EXPECT_FALSE(advised(text, "large_output", 1e9));
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("mesogen-advice-{}", ::getpid());
  const auto bytes = [&](const std::vector<std::string>& settings) {
    Problems problems;
    Case source = read_case_text(text.text(), "test.toml", settings, problems);
    Log log(true);
    std::ostringstream silent;
    Progress progress(silent, Progress::Style::silent);
    RunOptions options;
    options.folder = folder;
    options.overwrite = true;
    EXPECT_EQ(run_case(std::move(source), built_plugins(), options, log, progress), ExitCode::done);
    const double size = static_cast<double>(std::filesystem::file_size(folder / "results.h5"));
    std::filesystem::remove_all(folder);
    return size;
  };
  EXPECT_NEAR(bytes({}) / bytes(found->settings), 13.0, 2.6);
}

}  // namespace
