#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "defect_field.hpp"

namespace {

using namespace mesogen;
using mesogen::director::DefectField;

constexpr double pi = std::numbers::pi;

Scene box(double width, double height) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {width, height, 0.0};
  return scene;
}

Parameter::Rows four_defects(double width, double height) {
  return {{0.21 * width, 0.3 * height, 0.5},
          {0.8 * width, 0.35 * height, -0.5},
          {0.6 * width, 0.9 * height, 0.5},
          {0.55 * width, 0.5 * height, -0.5}};
}

/// Turns of the director, in multiples of 2 pi, along a circle.
double turns_around(const DefectField& field, double x, double y, double radius) {
  constexpr int points = 64;
  const auto angle = [&](int n) {
    return field.at(x + radius * std::cos(2 * pi * n / points), y + radius * std::sin(2 * pi * n / points)).angle;
  };
  double sum = 0.0;
  for (int n = 0; n < points; ++n) sum += std::remainder(angle(n + 1) - angle(n), pi);
  return sum / (2 * pi);
}

/// How far apart two directors are; a director has no head.
double difference(double a, double b) { return std::abs(std::remainder(a - b, pi)); }

class InitialDefects : public ::testing::TestWithParam<std::pair<double, double>> {
 protected:
  [[nodiscard]] double width() const { return GetParam().first; }
  [[nodiscard]] double height() const { return GetParam().second; }
  [[nodiscard]] DefectField field() const { return {four_defects(width(), height()), 0.1, box(width(), height())}; }
};

TEST_P(InitialDefects, TurnByTheirCharge) {
  for (const auto& defect : four_defects(width(), height()))
    EXPECT_NEAR(turns_around(field(), defect[0], defect[1], 0.3), defect[2], 1e-12);
  EXPECT_NEAR(turns_around(field(), 0.3 * width(), 0.7 * height(), 0.3), 0.0, 1e-12);
}

TEST_P(InitialDefects, FitThePeriodicBox) {
  const double tiny = 1e-9;
  for (double s = 0.013; s < 1.0; s += 0.1) {
    const DefectField all = field();
    EXPECT_LT(difference(all.at(s * width(), tiny).angle, all.at(s * width(), height() - tiny).angle), 1e-7);
    EXPECT_LT(difference(all.at(tiny, s * height()).angle, all.at(width() - tiny, s * height()).angle), 1e-7);
  }
}

TEST_P(InitialDefects, LeaveTheAngleHarmonic) {
  const double x = 0.37 * width();
  const double y = 0.66 * height();
  const double e = 1e-3;
  const DefectField all = field();
  double laplacian = 0.0;
  for (const auto& [dx, dy] : {std::pair(e, 0.0), std::pair(-e, 0.0), std::pair(0.0, e), std::pair(0.0, -e)})
    laplacian += std::remainder(all.at(x + dx, y + dy).angle - all.at(x, y).angle, pi) / (e * e);
  EXPECT_NEAR(laplacian, 0.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Boxes, InitialDefects,
                         ::testing::Values(std::pair(10.0, 10.0), std::pair(20.0, 5.0), std::pair(6.0, 30.0),
                                           std::pair(5.0, 1000.0)));

TEST(DefectField, HasNoOrderInTheCoreOfADefect) {
  const DefectField field({{2.0, 5.0, 0.5}, {7.0, 5.0, -0.5}}, 0.2, box(10.0, 10.0));
  EXPECT_EQ(field.at(2.0, 5.0).order, 0.0);
  EXPECT_NEAR(field.at(2.2, 5.0).order, 1.0 / std::sqrt(3.0), 2e-3);
  EXPECT_NEAR(field.at(4.5, 5.0).order, 1.0, 0.02);
}

// A pair close together disturbs the far field little, also where a face of the box lies between the two.
TEST(DefectField, TakesTheShortWayBetweenAPair) {
  const DefectField field({{19.6, 10.0, 0.5}, {0.4, 10.0, -0.5}}, 0.1, box(20.0, 20.0));
  for (const auto& [x, y] : {std::pair(10.0, 10.0), std::pair(5.0, 3.0)})
    EXPECT_LT(difference(field.at(x, y).angle, field.at(10.0, 0.5).angle), 0.1);
}

}  // namespace
