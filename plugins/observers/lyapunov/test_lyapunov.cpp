#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/testing/plugin_harness.hpp"
#include "observer_context_with.hpp"

namespace mesogen::test {
namespace {

/// A velocity gradient: du/dx, du/dy, dv/dx, dv/dy, 1/s.
using Gradient = std::array<double, 4>;

/// Made-up states at times of their own, in which the gradient is the same everywhere.
class Flow {
 public:
  ObserverUnderTest observer{"lyapunov"};

  explicit Flow(const Gradient& gradient) { become(gradient); }
  void become(const Gradient& gradient) {
    std::vector<FakeObserverContext::Function> components;
    for (const double value : gradient) components.emplace_back([value](double, double) { return value; });
    particles.set("velocity_gradient", components);
  }
  void start(double time = 0.0) { observer.start(ObserverContextWith(particles, false, time)); }
  auto sample(double time) { return observer.sample(ObserverContextWith(particles, false, time)); }
  double number(double time, const std::string& quantity) { return sample(time).at(quantity).at(0); }

  FakeObserverContext particles{20, 20, 1.0, 1.0};
};

TEST(Lyapunov, PureStrainStretchesAtItsRate) {
  Flow flow({0.7, 0.0, 0.0, -0.7});
  flow.observer.set("from", 30.0);
  flow.start();
  for (const double time : {10.0, 20.0, 30.0}) EXPECT_TRUE(std::isnan(flow.number(time, "exponent")));
  const auto values = flow.sample(50.0);
  EXPECT_NEAR(values.at("exponent")[0], 0.7, 1e-13);
  EXPECT_NEAR(values.at("exponent_error")[0], 0.0, 1e-13);
  EXPECT_NEAR(values.at("finite_time_mean")[0], 0.7, 1e-13);
  EXPECT_NEAR(values.at("finite_time_deviation")[0], 0.0, 1e-13);
}

TEST(Lyapunov, NoGrowthIsTooMuch) {
  Flow flow({0.0, 40.0, 40.0, 0.0});
  flow.observer.set("count", std::int64_t{4});
  flow.start();
  (void)flow.sample(1.0);
  EXPECT_NEAR(flow.number(100.0, "finite_time_mean"), 40.0, 1e-10) << "exp(3960) is no number";
}

TEST(Lyapunov, RotationStretchesNothing) {
  Flow flow({0.0, -3.0, 3.0, 0.0});
  flow.start();
  for (int n = 1; n <= 40; ++n) {
    const auto values = flow.sample(0.7 * n);
    EXPECT_NEAR(values.at("exponent")[0], 0.0, 1e-14);
    EXPECT_NEAR(values.at("finite_time_deviation")[0], 0.0, 1e-14);
  }
}

TEST(Lyapunov, ShearStretchesByItsLogarithm) {
  constexpr double rate = 2.0;
  Flow flow({0.0, rate, 0.0, 0.0});
  flow.observer.set("count", std::int64_t{5});
  flow.start();
  const auto direction = flow.observer->save().at("direction");
  for (const double time : {0.25, 1.0, 4.0, 100.0}) {
    std::array<double, 5> exponent{};
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < 5; ++i) {
      exponent.at(i) =
          std::log(std::hypot(direction[2 * i] + rate * time * direction[2 * i + 1], direction[2 * i + 1])) / time;
      mean += exponent.at(i) / 5.0;
    }
    for (const double one : exponent) square += (one - mean) * (one - mean);
    const auto values = flow.sample(time);
    EXPECT_NEAR(values.at("exponent")[0], mean, 1e-12) << time;
    EXPECT_NEAR(values.at("exponent_error")[0], std::sqrt(square / 4.0 / 5.0), 1e-12) << time;
  }
  EXPECT_LT(flow.number(1e4, "exponent"), 0.002);
}

TEST(Lyapunov, MomentsOfTheLastWindowAreOverParticles) {
  Flow flow({});
  // Gradients diag(s, -s) with s = 1 for even and 3 for odd ids; after the first window all vectors point along x.
  const auto zero = [](double, double) { return 0.0; };
  flow.particles.set("velocity_gradient", {zero, zero, zero, zero});
  flow.observer.set("count", std::int64_t{400});
  flow.start();
  const auto rate = [](double x, double) { return static_cast<int>(x * 20.0) % 2 == 0 ? 1.0 : 3.0; };
  flow.particles.set("velocity_gradient", {rate, zero, zero, [=](double x, double y) { return -rate(x, y); }});
  flow.particles.store_anew(5);
  (void)flow.sample(0.0);
  (void)flow.sample(40.0);
  const auto values = flow.sample(40.5);
  EXPECT_NEAR(values.at("finite_time_mean")[0], 2.0, 1e-12);
  EXPECT_NEAR(values.at("finite_time_deviation")[0], std::sqrt(400.0 / 399.0), 1e-12);
}

// Shears in turn along x and y, each for a time T: their product [[1 + g^2, g], [g, 1]], g = rate T, has the trace
// 2 + g^2, so both exponents are +-arcosh(1 + g^2 / 2) / 2T.
TEST(Lyapunov, ShearsInTurnHaveTheExponentOfTheirProduct) {
  constexpr double rate = 1.5;
  constexpr double length = 0.8;
  Flow flow({0.0, rate, 0.0, 0.0});
  flow.observer.set("from", 40 * length);
  flow.start();
  std::map<std::string, std::vector<double>, std::less<>> values;
  for (int n = 1; n <= 60; ++n) {
    (void)flow.sample(n * length);
    // Seen twice at one time, a gradient may jump.
    flow.become(n % 2 == 0 ? Gradient{0.0, rate, 0.0, 0.0} : Gradient{0.0, 0.0, rate, 0.0});
    values = flow.sample(n * length);
  }
  const double product = std::acosh(1.0 + 0.5 * std::pow(rate * length, 2));
  EXPECT_NEAR(values.at("exponent")[0], product / (2.0 * length), 1e-12);
  EXPECT_NEAR(values.at("exponent_error")[0], 0.0, 1e-12);
}

// A strain s that turns at the rate w < s: in axes that turn with it the gradient stays, [[s, w], [-w, -s]], and the
// exponent is sqrt(s^2 - w^2).
TEST(Lyapunov, ErrorFallsWithTheSquareOfTheInterval) {
  constexpr double s = 1.0;
  constexpr double w = 0.6;
  const auto at = [](double time) {
    return Gradient{s * std::cos(2 * w * time), s * std::sin(2 * w * time), s * std::sin(2 * w * time),
                    -s * std::cos(2 * w * time)};
  };
  const auto error = [&](double interval) {
    Flow flow(at(0.0));
    flow.observer.set("from", 24.0);
    flow.start();
    const int samples = static_cast<int>(std::lround(48.0 / interval));
    double exponent = 0.0;
    for (int n = 1; n <= samples; ++n) {
      flow.become(at(n * interval));
      exponent = flow.number(n * interval, "exponent");
    }
    return exponent - std::sqrt(s * s - w * w);
  };
  EXPECT_NEAR(error(0.2) / error(0.1), 4.0, 0.05);
  EXPECT_LT(std::abs(error(0.1)), 4e-3);
}

TEST(Lyapunov, AveragesBeginWithTheFirstWindowAfterFrom) {
  Flow flow({1.0, 0.0, 0.0, -1.0});
  flow.observer.set("from", 25.0);
  flow.start();
  (void)flow.sample(20.0);
  for (const auto& [name, values] : flow.sample(30.0))
    EXPECT_TRUE(std::isnan(values[0])) << name << " of a window that began before";
  flow.become({3.0, 0.0, 0.0, -3.0});
  EXPECT_NEAR(flow.number(34.0, "exponent"), 2.0, 1e-12);
  EXPECT_NEAR(flow.number(35.0, "exponent"), 11.0 / 5.0, 1e-12);
  EXPECT_NEAR(flow.number(35.0, "finite_time_mean"), 3.0, 1e-12);
}

TEST(Lyapunov, NothingPassedYet) {
  Flow flow({1.0, 0.0, 0.0, -1.0});
  flow.start(3.0);
  for (const auto& [name, values] : flow.sample(3.0)) EXPECT_TRUE(std::isnan(values[0])) << name;
}

TEST(Lyapunov, ContinuesWhereItWasSaved) {
  Flow first({0.2, 1.0, -0.3, 0.1});
  first.start();
  first.become({-0.4, 0.5, 0.9, 0.2});
  (void)first.sample(0.5);
  Flow second({-0.4, 0.5, 0.9, 0.2});
  second.observer.plan(second.particles.scene());
  second.observer->restore(first.observer->save());
  for (Flow* const flow : {&first, &second}) flow->become({0.1, -0.2, 2.0, 0.0});
  second.particles.store_anew(3);
  EXPECT_EQ(second.sample(0.5), first.sample(0.5));
  EXPECT_EQ(second.sample(1.2), first.sample(1.2));
  EXPECT_EQ(second.observer->save(), first.observer->save());
  EXPECT_GT(first.number(1.2, "exponent"), 0.0);
}

TEST(Lyapunov, ChoosesParticlesEvenlyByIdAndSeed) {
  const auto ids = [](std::int64_t count, std::int64_t seed) {
    Flow flow({});
    flow.observer.set("count", count);
    flow.observer.set("seed", seed);
    flow.start();
    return flow.observer->save().at("id");
  };
  const auto chosen = ids(150, 1);
  ASSERT_EQ(chosen.size(), 150U);
  for (std::size_t n = 0; n < 150; ++n) EXPECT_NEAR(chosen[n], 400.0 / 150.0 * (static_cast<double>(n) + 0.5), 2.0);
  EXPECT_EQ(ids(150, 1), chosen);
  EXPECT_NE(ids(150, 2), chosen);
  EXPECT_EQ(ids(1000, 1).size(), 400U) << "all, if there are fewer";
}

TEST(Lyapunov, DirectionsAreOfLengthOneAndKnowNoAxes) {
  Flow flow({});
  flow.observer.set("count", std::int64_t{400});
  flow.start();
  const auto direction = flow.observer->save().at("direction");
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_NEAR(std::hypot(direction[2 * i], direction[2 * i + 1]), 1.0, 1e-15);
    xx += direction[2 * i] * direction[2 * i] / 400.0;
    xy += direction[2 * i] * direction[2 * i + 1] / 400.0;
  }
  // Four standard deviations, each sqrt(1/8) / 20.
  EXPECT_NEAR(xx, 0.5, 0.07);
  EXPECT_NEAR(xy, 0.0, 0.07);
}

TEST(Lyapunov, NeedsAFlowThatMovesItsParticles) {
  Flow flow({});
  EXPECT_EQ(flow.observer.plan(flow.particles.scene()).read_list(), std::vector<std::string>{"velocity_gradient"});
  testing::TestScene scene;
  scene.more = "[physics.flow]\ntype = \"wcsph\"\ndensity = 1.0\nviscosity = 0.1\nsound_speed = 10.0\n";
  testing::PluginHarness(PluginKind::observer, "lyapunov", "", scene).start();
  scene.more += "motion = \"eulerian\"\n";
  try {
    testing::PluginHarness(PluginKind::observer, "lyapunov", "", scene).start();
    FAIL() << "a flow past particles that stay";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_NE(std::string(error.what()).find("particles stay where they are, so this observer would see nothing move"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace mesogen::test
