#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fake_observer_context.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double length_x = 1.6;
constexpr double length_y = 1.2;
constexpr double spacing = 0.02;

struct Prescribed {
  double x, y, charge;
};

/// A director with these defects and their periodic images; the order falls to 0 in cores of radius `core`, m.
/// Charges and their dipole sum to 0, so that the director is periodic.
struct Director {
  std::vector<Prescribed> defects;
  double background = 0.3;
  double core = spacing;

  /// Angle at a point, without the contribution of defect `except` itself (its images count).
  [[nodiscard]] double angle(double x, double y, std::size_t except = 99) const {
    double theta = background;
    for (std::size_t n = 0; n < defects.size(); ++n) {
      for (int b = -6; b <= 6; ++b) {
        for (int a = -6; a <= 6; ++a) {
          if (n == except && a == 0 && b == 0) continue;
          theta += defects[n].charge * std::atan2(y - defects[n].y + b * length_y, x - defects[n].x + a * length_x);
        }
      }
    }
    return theta;
  }
  [[nodiscard]] double order(double x, double y) const {
    double q = 1.0;
    for (const auto& defect : defects) {
      const double dx = std::remainder(x - defect.x, length_x);
      const double dy = std::remainder(y - defect.y, length_y);
      q *= std::sqrt((dx * dx + dy * dy) / (dx * dx + dy * dy + 2 * core * core));
    }
    return q;
  }
  void give_to(FakeObserverContext& context) const {
    context.set("order_tensor", {[this](double x, double y) { return order(x, y) * std::cos(2 * angle(x, y)); },
                                 [this](double x, double y) { return order(x, y) * std::sin(2 * angle(x, y)); }});
  }
};

/// Two defects of each charge around a point, along two lines that cross there.
Director four_defects(double x, double y) {
  return {{{x + 0.31, y + 0.083, 0.5},
           {x - 0.31, y - 0.083, 0.5},
           {x - 0.113, y + 0.27, -0.5},
           {x + 0.113, y - 0.27, -0.5}}};
}

FakeObserverContext lattice() {
  return {static_cast<int>(std::lround(length_x / spacing)), static_cast<int>(std::lround(length_y / spacing)),
          length_x, length_y};
}

ObserverUnderTest observer_for(const FakeObserverContext& context, double merge_distance = 1.5) {
  ObserverUnderTest observer("defects");
  observer.set("merge_distance", merge_distance);
  observer.start(context);
  return observer;
}

/// Expects that the prescribed defects were found, and no others, each within `position` spacings and `angle` rad.
void expect_found(const Director& director, const FakeObserverContext& context, double position, double angle) {
  const auto values = observer_for(context).sample(context);
  EXPECT_EQ(values.at("count_plus")[0], 2.0);
  EXPECT_EQ(values.at("count_minus")[0], 2.0);
  EXPECT_EQ(values.at("total_charge")[0], 0.0);
  const auto& rows = values.at("defects");
  ASSERT_EQ(rows.size(), 16U);
  for (std::size_t n = 0; n < director.defects.size(); ++n) {
    const auto& wanted = director.defects[n];
    double nearest = 1e9;
    double orientation = 0.0;
    for (std::size_t r = 0; r < rows.size(); r += 4) {
      EXPECT_TRUE(rows[r] >= 0.0 && rows[r] < length_x && rows[r + 1] >= 0.0 && rows[r + 1] < length_y);
      const double distance =
          std::hypot(std::remainder(rows[r] - wanted.x, length_x), std::remainder(rows[r + 1] - wanted.y, length_y));
      if (rows[r + 2] == wanted.charge && distance < nearest) {
        nearest = distance;
        orientation = rows[r + 3];
      }
    }
    EXPECT_LT(nearest, position * spacing) << "defect " << n;
    // Where director angle and polar angle agree: charge * phi + rest = phi.
    const double rest = director.angle(wanted.x, wanted.y, n);
    const double turn = wanted.charge > 0 ? 2 * pi : 2 * pi / 3;
    EXPECT_NEAR(std::remainder(orientation - rest / (1 - wanted.charge), turn), 0.0, angle) << "defect " << n;
  }
}

TEST(Defects, FindsPrescribedDefects) {
  const auto director = four_defects(0.81, 0.587);
  auto context = lattice();
  director.give_to(context);
  expect_found(director, context, 0.1, 0.05);
}

TEST(Defects, FindsThemAcrossTheCornerOfTheBox) {
  const auto director = four_defects(0.01, 1.19);
  auto context = lattice();
  director.give_to(context);
  expect_found(director, context, 0.1, 0.05);
}

TEST(Defects, FindsThemAmongDisorderedParticles) {
  const auto director = four_defects(0.5, 0.4);
  auto context = lattice();
  context.jitter(0.3, 4);
  director.give_to(context);
  expect_found(director, context, 0.5, 0.15);
}

TEST(Defects, FindsThemWithoutACore) {
  auto director = four_defects(0.777, 0.612);
  director.core = 0.0;
  auto context = lattice();
  director.give_to(context);
  expect_found(director, context, 0.5, 0.05);
}

TEST(Defects, FindsThemWithAWideCore) {
  auto director = four_defects(0.777, 0.612);
  director.core = 4 * spacing;
  auto context = lattice();
  director.give_to(context);
  expect_found(director, context, 0.5, 0.1);
}

TEST(Defects, OrientationTurnsWithTheDirector) {
  for (const double background : {-1.2, 0.0, 0.5, 1.4}) {
    auto director = four_defects(0.81, 0.587);
    director.background = background;
    auto context = lattice();
    director.give_to(context);
    expect_found(director, context, 0.1, 0.05);
  }
}

TEST(Defects, OrientationOfACometIsFromHeadToTail) {
  // Only near (0.8, 0.6) is the director that of one defect: the bend (head) to its left, the straight tail to its
  // right.
  auto context = lattice();
  const auto phase = [](double x, double y) { return std::atan2(y - 0.6, x - 0.8); };
  context.set("order_tensor", {[&](double x, double y) { return std::cos(phase(x, y)); },
                               [&](double x, double y) { return std::sin(phase(x, y)); }});
  const auto rows = observer_for(context).sample(context).at("defects");
  double orientation = 9.0;
  for (std::size_t r = 0; r < rows.size(); r += 4) {
    if (std::hypot(rows[r] - 0.8, rows[r + 1] - 0.6) < spacing) orientation = rows[r + 3];
  }
  EXPECT_NEAR(orientation, 0.0, 1e-6);
}

TEST(Defects, AUniformDirectorHasNone) {
  auto context = lattice();
  context.jitter(0.4, 1);
  context.set("order_tensor", {[](double, double) { return -0.4; }, [](double, double) { return 1e-17; }});
  const auto values = observer_for(context).sample(context);
  EXPECT_EQ(values.at("count_plus")[0], 0.0);
  EXPECT_EQ(values.at("count_minus")[0], 0.0);
  EXPECT_TRUE(values.at("defects").empty());
}

TEST(Defects, TotalChargeIsZeroWhateverTheField) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    auto context = lattice();
    context.jitter(0.5, seed);
    const auto noise = [&](double, double) { return normal(random); };
    context.set("order_tensor", {noise, noise});
    for (const double merge_distance : {0.0, 1.5, 4.0}) {
      const auto values = observer_for(context, merge_distance).sample(context);
      EXPECT_GT(values.at("count_plus")[0], merge_distance > 3.0 ? 0.0 : 20.0);
      EXPECT_EQ(values.at("count_plus")[0], values.at("count_minus")[0]);
      EXPECT_EQ(values.at("total_charge")[0], 0.0);
    }
  }
}

TEST(Defects, ClosePairsAreLeftOut) {
  // A pair 6 spacings apart, and another far away that makes the dipole vanish.
  const double d = 3 * spacing;
  const Director director{{{0.5 - d, 0.4, 0.5}, {0.5 + d, 0.4, -0.5}, {1.1 - d, 0.8, -0.5}, {1.1 + d, 0.8, 0.5}}};
  auto context = lattice();
  director.give_to(context);
  EXPECT_EQ(observer_for(context, 5.0).number(context, "count_plus"), 2.0);
  EXPECT_EQ(observer_for(context, 7.0).number(context, "count_plus"), 0.0);
  EXPECT_EQ(observer_for(context, 7.0).number(context, "count_minus"), 0.0);
}

TEST(Defects, PairDistanceIsThatOfTheClosestOppositeCharges) {
  const auto distance = [](const Director& director) {
    auto context = lattice();
    director.give_to(context);
    return observer_for(context).number(context, "pair_distance");
  };
  const Director inside{{{0.4, 0.3, 0.5}, {0.8, 0.3, -0.5}, {0.8, 0.9, 0.5}, {0.4, 0.9, -0.5}}};
  EXPECT_NEAR(distance(inside), 0.4, 0.1 * spacing);
  const Director across_a_face{{{1.4, 0.3, 0.5}, {1.8, 0.3, -0.5}, {1.8, 0.9, 0.5}, {1.4, 0.9, -0.5}}};
  EXPECT_NEAR(distance(across_a_face), 0.4, 0.1 * spacing);
  EXPECT_TRUE(std::isnan(distance(Director{})));
}

TEST(Defects, AHoleInTheParticlesIsFilledFromItsRim) {
  const auto director = four_defects(0.81, 0.587);
  auto context = lattice();
  for (std::size_t id = 0; id < 8; ++id) {
    for (std::size_t row = 0; row < 8; ++row) context.place(80 * row + id, 0.4, 0.02 + 0.01 * static_cast<double>(row));
  }
  director.give_to(context);
  expect_found(director, context, 0.1, 0.05);
}

TEST(Defects, OrderOfStorageDoesNotMatter) {
  const auto director = four_defects(0.3, 0.3);
  auto context = lattice();
  context.jitter(0.3, 4);
  director.give_to(context);
  const auto before = observer_for(context).sample(context);
  context.store_anew(6);
  const auto after = observer_for(context).sample(context);
  for (const auto& [quantity, values] : before) {
    ASSERT_EQ(after.at(quantity).size(), values.size()) << quantity;
    for (std::size_t n = 0; n < values.size(); ++n) EXPECT_NEAR(after.at(quantity)[n], values[n], 1e-12) << quantity;
  }
}

}  // namespace
}  // namespace mesogen::test
