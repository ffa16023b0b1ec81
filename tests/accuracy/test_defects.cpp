// Defects: their cores, how they attract each other, and how active ones drive themselves.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

/// Profile of a core, f'' + f'/x - f/x^2 + f - f^3 = 0 with f(0) = 0, f'(0) = 0.58318: order over its equilibrium at a
/// distance of x core radii xi = sqrt(K / |A|). Good to x = 4.
double core_profile(double distance) {
  constexpr double from = 1e-3;
  constexpr double step = 1e-3;
  using State = std::array<double, 2>;
  const auto slope = [](double x, const State& s) {
    return State{s[1], -s[1] / x + s[0] / (x * x) - s[0] + s[0] * s[0] * s[0]};
  };
  const auto moved = [](const State& s, const State& by, double h) {
    return State{s[0] + h * by[0], s[1] + h * by[1]};
  };
  State s{0.58318 * from, 0.58318};
  double x = from;
  while (x < distance) {
    const double h = std::min(step, distance - x);
    const State a = slope(x, s);
    const State b = slope(x + h / 2, moved(s, a, h / 2));
    const State c = slope(x + h / 2, moved(s, b, h / 2));
    const State d = slope(x + h, moved(s, c, h));
    for (std::size_t n = 0; n < 2; ++n) s[n] += h / 6 * (a[n] + 2 * b[n] + 2 * c[n] + d[n]);
    x += h;
  }
  return s[0];
}

struct Defect {
  double x, y, charge, orientation;
};

std::vector<Defect> defects_of(CaseRun& run) {
  const auto sample = run.sample("defects");
  EXPECT_EQ(sample.values().at("total_charge").at(0), 0.0);
  const auto& rows = sample.values().at("defects");
  std::vector<Defect> defects;
  for (std::size_t n = 0; n + 4 <= rows.size(); n += 4)
    defects.push_back({rows[n], rows[n + 1], rows[n + 2], rows[n + 3]});
  return defects;
}

Defect with_charge(const std::vector<Defect>& defects, double charge) {
  for (const Defect& defect : defects)
    if (defect.charge == charge) return defect;
  ADD_FAILURE() << "no defect of charge " << charge;
  return {};
}

TEST(Defects, ProfileIsTheKnownOne) {
  EXPECT_NEAR(core_profile(0.5), 0.2828, 1e-4);
  EXPECT_NEAR(core_profile(1.0), 0.5201, 1e-4);
  EXPECT_NEAR(core_profile(2.0), 0.8050, 1e-4);
  EXPECT_NEAR(core_profile(3.0), 0.9175, 2e-4);
}

// A chequerboard of defects stands still, and near each the others cancel to first order.
TEST(Defects, CoreHasTheExactProfile) {
  constexpr double xi = 0.1414213562373095;  // K = 0.02, A = -1
  constexpr int across = 80;
  constexpr double length = 16.0 * xi;  // 5 particles a core radius
  CaseText text(length, across);
  const double a = length / 4;
  const double b = 3 * length / 4;
  text.section("director",
               fmt::format("type = \"defects\"\ncore = {2:.17g}\ndefects = [[{0:.17g}, {0:.17g}, 0.5], [{1:.17g}, "
                           "{0:.17g}, -0.5], [{0:.17g}, {1:.17g}, -0.5], [{1:.17g}, {1:.17g}, 0.5]]",
                           a, b, xi))
      .nematic(0.4, 0.7, 0.02);
  CaseRun run(text);
  run.run_to(12.0);
  const auto q11 = run.field("order_tensor", 0);
  const auto q12 = run.field("order_tensor", 1);
  const auto x = run.path(0);
  const auto y = run.path(1);
  // Mean deviation over rings of half a core radius
  std::array<double, 6> error{};
  std::array<int, 6> count{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i] - a, y[i] - a) / xi;
    if (r >= 3.0) continue;
    const auto ring = static_cast<std::size_t>(2.0 * r);
    error[ring] += std::hypot(q11[i], q12[i]) / core_profile(r) - 1.0;
    ++count[ring];
  }
  for (std::size_t ring = 0; ring < error.size(); ++ring) {
    ASSERT_GT(count[ring], 10);
    EXPECT_NEAR(error[ring] / count[ring], 0.0, 0.01) << "from " << 0.5 * static_cast<double>(ring) << " core radii";
  }
}

TEST(Defects, PairAttractsAndMeetsInTheMiddle) {
  CaseText text(10.0, 64);
  text.section("director", "type = \"defects\"\ncore = 0.4\ndefects = [[3.75, 5.0, 0.5], [6.25, 5.0, -0.5]]")
      .nematic(1.0, 0.7, 0.2);
  CaseRun run(text);
  double distance = 2.5;
  for (double time = 0.5; time <= 2.5; time += 0.5) {
    run.run_to(time);
    const auto defects = defects_of(run);
    ASSERT_EQ(defects.size(), 2U) << "t = " << time;
    const Defect plus = with_charge(defects, 0.5);
    const Defect minus = with_charge(defects, -0.5);
    const double spacing = 10.0 / 64;
    EXPECT_NEAR(plus.x + minus.x, 10.0, 0.3 * spacing) << "t = " << time;
    EXPECT_NEAR(plus.y, 5.0, 0.2 * spacing);
    EXPECT_NEAR(minus.y, 5.0, 0.2 * spacing);
    EXPECT_LT(minus.x - plus.x, distance - 0.02) << "t = " << time;
    distance = minus.x - plus.x;
  }
  run.run_to(40.0);
  EXPECT_EQ(defects_of(run).size(), 0U);
}

/// How far along its head the +1/2 of a pair goes in 4 s with this activity, m. The pair is far apart, and the elastic
/// attraction weak.
double way_along_head(double activity) {
  CaseText text(10.0, 64);
  text.section("director", "type = \"defects\"\ncore = 0.2\ndefects = [[2.5, 5.0, 0.5], [7.5, 5.0, -0.5]]")
      .flow(0.5)
      .nematic(0.4, 0.7, 0.02)
      .active(activity);
  CaseRun run(text);
  run.run_to(0.5);
  const Defect begun = with_charge(defects_of(run), 0.5);
  const Defect other = with_charge(defects_of(run), -0.5);
  run.run_to(4.5);
  const Defect now = with_charge(defects_of(run), 0.5);
  const Defect other_now = with_charge(defects_of(run), -0.5);
  const double way = std::hypot(now.x - begun.x, now.y - begun.y);
  EXPECT_GT(way, 2.0 * std::hypot(other_now.x - other.x, other_now.y - other.y)) << "the -1/2 drives itself too";
  // `orientation` points from head to tail.
  return -((now.x - begun.x) * std::cos(begun.orientation) + (now.y - begun.y) * std::sin(begun.orientation));
}

TEST(Defects, ExtensilePlusHalfMovesHeadFirstAndContractileTailFirst) {
  const double extensile = way_along_head(0.05);
  const double contractile = way_along_head(-0.05);
  EXPECT_GT(extensile, 0.1);
  EXPECT_LT(contractile, -0.1);
}

}  // namespace
