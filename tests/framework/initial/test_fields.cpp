#include "initial/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mesogen {
namespace {

constexpr double pi = std::numbers::pi;

Case box(double width, double height) {
  Case source;
  source.domain.size = {width, height};
  source.particles.spacing = 0.1;
  source.director.given = true;
  source.director.core = 0.1;
  return source;
}

Arrangement points(std::vector<double> x, std::vector<double> y) {
  Arrangement result;
  result.count = static_cast<Index>(x.size());
  result.position = {std::move(x), std::move(y), {}};
  return result;
}

TEST(InitialDirector, IsUniform) {
  auto source = box(3.0, 3.0);
  source.director.angle = 0.3;
  source.director.order = 0.8;
  const auto tensor = initial_order_tensor(source, points({0.1, 2.0}, {0.2, 1.0}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_DOUBLE_EQ(tensor[0][i], 0.8 * std::cos(0.6));
    EXPECT_DOUBLE_EQ(tensor[1][i], 0.8 * std::sin(0.6));
  }
}

TEST(InitialDirector, AddsModes) {
  auto source = box(4.0, 2.0);
  source.director.type = "modes";
  source.director.angle = 0.1;
  source.director.modes = {{1, 0, 0.05, 0.3}, {2, -1, 0.02, 0.7}};
  const auto tensor = initial_order_tensor(source, points({0.7}, {1.9}));
  const double angle =
      0.1 + 0.05 * std::cos(2 * pi * 0.7 / 4 + 0.3) + 0.02 * std::cos(2 * pi * (2 * 0.7 / 4 - 1.9 / 2) + 0.7);
  EXPECT_NEAR(tensor[0][0], std::cos(2 * angle), 1e-14);
  EXPECT_NEAR(tensor[1][0], std::sin(2 * angle), 1e-14);
}

TEST(InitialDirector, IsPerturbedBySeedAndId) {
  auto source = box(4.0, 4.0);
  source.director.type = "perturbed";
  source.director.amplitude = 0.2;
  const auto particles = points(std::vector<double>(1000, 1.0), std::vector<double>(1000, 1.0));
  const auto first = initial_order_tensor(source, particles);
  EXPECT_EQ(first, initial_order_tensor(source, particles));
  source.director.seed = 5;
  EXPECT_NE(first, initial_order_tensor(source, particles));
  double largest = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const double angle = 0.5 * std::atan2(first[1][i], first[0][i]);
    largest = std::max(largest, std::abs(angle));
    mean += angle / 1000.0;
  }
  EXPECT_LE(largest, 0.2);
  EXPECT_GT(largest, 0.19);
  EXPECT_NEAR(mean, 0.0, 0.015);
}

/// Turns of the director, in multiples of 2 pi, along a closed polygon.
double turns(const Case& source, const std::vector<double>& x, const std::vector<double>& y) {
  const auto tensor = initial_order_tensor(source, points(x, y));
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::size_t next = (i + 1) % x.size();
    const double angle = std::atan2(tensor[1][i], tensor[0][i]);
    sum += std::remainder(std::atan2(tensor[1][next], tensor[0][next]) - angle, 2 * pi);
  }
  return sum / (4 * pi);
}

double turns_around(const Case& source, double x, double y, double radius) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (int n = 0; n < 64; ++n) {
    xs.push_back(x + radius * std::cos(2 * pi * n / 64));
    ys.push_back(y + radius * std::sin(2 * pi * n / 64));
  }
  return turns(source, xs, ys);
}

Case with_defects(double width, double height) {
  auto source = box(width, height);
  source.director.type = "defects";
  source.director.angle = 0.4;
  source.director.defects = {{0.21 * width, 0.3 * height, 0.5},
                             {0.8 * width, 0.35 * height, -0.5},
                             {0.6 * width, 0.9 * height, 0.5},
                             {0.55 * width, 0.5 * height, -0.5}};
  return source;
}

class InitialDefects : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(InitialDefects, TurnByTheirCharge) {
  const auto source = with_defects(GetParam().first, GetParam().second);
  for (const auto& defect : source.director.defects)
    EXPECT_NEAR(turns_around(source, defect[0], defect[1], 0.3), defect[2], 1e-12);
  EXPECT_NEAR(turns_around(source, 0.3 * GetParam().first, 0.7 * GetParam().second, 0.3), 0.0, 1e-12);
}

TEST_P(InitialDefects, FitThePeriodicBox) {
  const auto [width, height] = GetParam();
  const auto source = with_defects(width, height);
  for (double s = 0.013; s < 1.0; s += 0.1) {
    const double tiny = 1e-9;
    const auto tensor = initial_order_tensor(
        source, points({s * width, s * width, tiny, width - tiny}, {tiny, height - tiny, s * height, s * height}));
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(tensor[c][0], tensor[c][1], 1e-7);
      EXPECT_NEAR(tensor[c][2], tensor[c][3], 1e-7);
    }
  }
}

TEST_P(InitialDefects, LeaveTheAngleHarmonic) {
  const auto [width, height] = GetParam();
  const auto source = with_defects(width, height);
  const double x = 0.37 * width;
  const double y = 0.66 * height;
  const double e = 1e-3;
  const auto tensor = initial_order_tensor(source, points({x, x + e, x - e, x, x}, {y, y, y, y + e, y - e}));
  const auto angle = [&](std::size_t i) { return 0.5 * std::atan2(tensor[1][i], tensor[0][i]); };
  double laplacian = 0.0;
  for (std::size_t i = 1; i < 5; ++i) laplacian += std::remainder(angle(i) - angle(0), pi) / (e * e);
  EXPECT_NEAR(laplacian, 0.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Boxes, InitialDefects,
                         ::testing::Values(std::pair(10.0, 10.0), std::pair(20.0, 5.0), std::pair(6.0, 30.0),
                                           std::pair(5.0, 1000.0)));

TEST(InitialDirector, HasNoOrderInTheCoreOfADefect) {
  auto source = box(10.0, 10.0);
  source.director.type = "defects";
  source.director.core = 0.2;
  source.director.defects = {{2.0, 5.0, 0.5}, {7.0, 5.0, -0.5}};
  const auto tensor = initial_order_tensor(source, points({2.0, 2.2, 4.5}, {5.0, 5.0, 5.0}));
  const auto order = [&](std::size_t i) { return std::hypot(tensor[0][i], tensor[1][i]); };
  EXPECT_EQ(order(0), 0.0);
  EXPECT_NEAR(order(1), 1.0 / std::sqrt(3.0), 2e-3);
  EXPECT_NEAR(order(2), 1.0, 0.02);
}

TEST(InitialDirector, TakesTheShortWayBetweenAPair) {
  // a pair close together disturbs the far field little, also where the faces of the box lie between them
  auto source = box(20.0, 20.0);
  source.director.type = "defects";
  source.director.angle = 0.4;
  source.director.defects = {{19.6, 10.0, 0.5}, {0.4, 10.0, -0.5}};
  const auto tensor = initial_order_tensor(source, points({10.0, 10.0, 5.0}, {0.5, 10.0, 3.0}));
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 0.5 * std::atan2(tensor[1][i], tensor[0][i]);
    EXPECT_LT(std::abs(std::remainder(angle - std::remainder(0.5 * std::atan2(tensor[1][0], tensor[0][0]), pi), pi)),
              0.1);
  }
}

TEST(InitialVelocity, RestsUnlessTold) {
  const auto u = initial_velocity(box(1.0, 1.0), points({0.5}, {0.5}));
  EXPECT_EQ(u[0], std::vector<double>{0.0});
  EXPECT_EQ(u[1], std::vector<double>{0.0});
}

TEST(InitialVelocity, IsUniform) {
  auto source = box(1.0, 1.0);
  source.velocity.type = "uniform";
  source.velocity.value = {0.5, -2.0};
  const auto u = initial_velocity(source, points({0.5, 0.1}, {0.5, 0.2}));
  EXPECT_EQ(u[0], (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(u[1], (std::vector<double>{-2.0, -2.0}));
}

TEST(InitialVelocity, FollowsTheStreamFunction) {
  auto source = box(4.0, 2.0);
  source.velocity.type = "modes";
  source.velocity.modes = {{1, 2, 0.3, 0.4}, {3, -1, 0.1, 1.0}};
  const auto psi = [](double x, double y) {
    return 0.3 * std::cos(2 * pi * (x / 4 + 2 * y / 2) + 0.4) + 0.1 * std::cos(2 * pi * (3 * x / 4 - y / 2) + 1.0);
  };
  const double x = 0.9;
  const double y = 1.3;
  const double e = 1e-5;
  const auto u = initial_velocity(source, points({x}, {y}));
  EXPECT_NEAR(u[0][0], (psi(x, y + e) - psi(x, y - e)) / (2 * e), 1e-8);
  EXPECT_NEAR(u[1][0], -(psi(x + e, y) - psi(x - e, y)) / (2 * e), 1e-8);
}

TEST(InitialColour, MarksAQuarter) {
  EXPECT_EQ(initial_colour(box(4.0, 2.0), points({1.9, 2.0, 1.9, 3.0}, {0.9, 0.9, 1.0, 1.5})),
            (std::vector<double>{1.0, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace mesogen
