#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "observer_context_with.hpp"
#include "one_defect.hpp"

namespace mesogen::test {
namespace {

constexpr std::size_t columns = 5;

ObserverUnderTest observer_with(const ObserverContext& context, double radius = 0.3, std::int64_t points = 21) {
  ObserverUnderTest observer("defect_flow");
  observer.set("radius", std::optional<double>(radius));
  observer.set("points", points);
  observer.start(context);
  return observer;
}

/// What a fresh observer makes of one defect in a box with walls.
std::map<std::string, std::vector<double>, std::less<>> seen(const OneDefect& defect, double jitter = 0.0) {
  auto context = lattice();
  if (jitter > 0.0) context.jitter(jitter, 5);
  defect.give_to(context);
  const ObserverContextWith walled(context, true);
  auto values = observer_with(walled).sample(walled);
  EXPECT_EQ(values.at("count_plus")[0], defect.charge > 0.0 ? 1.0 : 0.0);
  EXPECT_EQ(values.at("count_minus")[0], defect.charge > 0.0 ? 0.0 : 1.0);
  return values;
}

struct Errors {
  double largest = 0.0;  // of the velocity, over the largest speed
  double rms = 0.0;
  double vorticity = 0.0;  // largest, 8 spacings and more from the centre, over the largest
};

Errors errors_of(const std::vector<double>& rows, const OneDefect& defect) {
  Errors errors;
  double fastest = 0.0;
  double largest_curl = 0.0;
  for (std::size_t n = 0; n < rows.size(); n += columns) {
    const Complex z(rows[n], rows[n + 1]);
    const double error = std::abs(Complex(rows[n + 2], rows[n + 3]) - defect.velocity(z));
    fastest = std::max(fastest, std::abs(defect.velocity(z)));
    errors.largest = std::max(errors.largest, error);
    errors.rms += error * error / (static_cast<double>(rows.size()) / columns);
    if (std::abs(z) < 8.0 * spacing) continue;
    largest_curl = std::max(largest_curl, std::abs(defect.curl(z)));
    errors.vorticity = std::max(errors.vorticity, std::abs(rows[n + 4] - defect.curl(z)));
  }
  return {errors.largest / fastest, std::sqrt(errors.rms) / fastest, errors.vorticity / largest_curl};
}

TEST(DefectFlow, TheFormulaIsAStokesFlow) {
  // With eta = 1, and alpha in units of it. Centred differences, away from the centre.
  const double alpha = 4.0 * speed / disc;
  constexpr double h = 1e-4;
  const Complex i(0.0, 1.0);
  for (const double charge : {0.5, -0.5}) {
    const auto by_x = [&](const auto& f, Complex z) { return (f(z + h) - f(z - h)) / (2.0 * h); };
    const auto by_y = [&](const auto& f, Complex z) { return (f(z + i * h) - f(z - i * h)) / (2.0 * h); };
    const auto u = [&](Complex z) { return flow(charge, z); };
    const auto p = [&](Complex z) {
      return charge > 0.0 ? alpha / 2.0 * std::cos(std::arg(z)) : -alpha / 6.0 * std::cos(3.0 * std::arg(z));
    };
    const auto tensor = [&](Complex z) { return 0.5 * std::polar(1.0, 2.0 * charge * std::arg(z)); };
    for (const Complex z : {Complex(0.2, 0.1), Complex(-0.05, 0.3), Complex(-0.1, -0.2), Complex(0.3, -0.02)}) {
      EXPECT_NEAR(by_x(u, z).real() + by_y(u, z).imag(), 0.0, 1e-6);
      EXPECT_NEAR(by_x(u, z).imag() - by_y(u, z).real(), vorticity(charge, z), 1e-5);
      const Complex laplacian = (u(z + h) + u(z - h) + u(z + i * h) + u(z - i * h) - 4.0 * u(z)) / (h * h);
      const Complex force = by_x(tensor, z) - i * by_y(tensor, z);  // div Q
      const Complex slope(by_x(p, z), by_y(p, z));
      EXPECT_NEAR(std::abs(laplacian + alpha * force - slope), 0.0, 1e-3 * alpha);
    }
  }
}

TEST(DefectFlow, OfOneDefectIsTheFormulaWithin5Percent) {
  for (const double charge : {0.5, -0.5}) {
    for (const double orientation : {0.0, 1.0, -2.4}) {
      const OneDefect defect = formula(charge, orientation);
      const Errors errors = errors_of(seen(defect).at(charge > 0.0 ? "plus" : "minus"), defect);
      EXPECT_LT(errors.largest, 0.03) << charge << " at " << orientation;  // at the cusp in the centre
      EXPECT_LT(errors.rms, 0.005) << charge << " at " << orientation;
      EXPECT_LT(errors.vorticity, 0.03) << charge << " at " << orientation;
    }
  }
}

TEST(DefectFlow, SoItIsAmongDisorderedParticles) {
  for (const double charge : {0.5, -0.5}) {
    const OneDefect defect = formula(charge, 0.4);
    const Errors errors = errors_of(seen(defect, 0.3).at(charge > 0.0 ? "plus" : "minus"), defect);
    EXPECT_LT(errors.largest, 0.05);
    EXPECT_LT(errors.rms, 0.01);
  }
}

TEST(DefectFlow, VelocityIsThatOfTheLabInTheFrameOfTheDefect) {
  // A uniform flow is fitted to rounding; the frame is off by as much as the orientation was missed.
  const auto rows = seen(uniform_flow(0.5, 0.8)).at("plus");
  ASSERT_EQ(rows.size(), std::size_t{21} * 21 * columns);
  for (std::size_t n = 0; n < rows.size(); n += columns) {
    EXPECT_NEAR(std::hypot(rows[n + 2], rows[n + 3]), std::hypot(0.3, 0.2), 1e-12);
    EXPECT_NEAR(rows[n + 2], 0.3, 0.005);
    EXPECT_NEAR(rows[n + 3], -0.2, 0.005);
    EXPECT_NEAR(rows[n + 4], 0.7, 1e-12);
  }
}

TEST(DefectFlow, OfAMinusDefectIsTheMeanOverItsLegs) {
  // Of a uniform flow nothing is left; the vorticity is the same whichever way one looks.
  const auto rows = seen(uniform_flow(-0.5, 0.8)).at("minus");
  for (std::size_t n = 0; n < rows.size(); n += columns) {
    EXPECT_NEAR(rows[n + 2], 0.0, 1e-12);
    EXPECT_NEAR(rows[n + 3], 0.0, 1e-12);
    EXPECT_NEAR(rows[n + 4], 0.7, 1e-12);
  }
}

TEST(DefectFlow, PointsAreALatticeAroundTheDefectXFastest) {
  const auto rows = seen(uniform_flow(0.5, 0.0)).at("plus");
  for (std::size_t n = 0; n < rows.size(); n += columns) {
    const std::size_t point = n / columns;
    EXPECT_NEAR(rows[n], 0.03 * (static_cast<double>(point % 21) - 10.0), 1e-15);
    EXPECT_NEAR(rows[n + 1], 0.03 * (std::floor(static_cast<double>(point) / 21.0) - 10.0), 1e-15);
  }
  const std::size_t middle = columns * (21 * 10 + 10);
  EXPECT_EQ(rows[middle], 0.0);
  EXPECT_EQ(rows[middle + 1], 0.0);
}

TEST(DefectFlow, PointsBeyondAWallAreLeftOut) {
  OneDefect defect = uniform_flow(0.5, 0.0);
  defect.place = {0.1049, 0.6};  // the square goes 0.2 m beyond the wall at x = 0
  const auto rows = seen(defect).at("plus");
  for (std::size_t n = 0; n < rows.size(); n += columns) {
    if (std::abs(rows[n] + 0.1049) < 0.01) continue;
    EXPECT_EQ(std::isnan(rows[n + 2]), rows[n] < -0.1049) << rows[n];
    if (rows[n] > -0.1049) {
      EXPECT_NEAR(rows[n + 2], 0.3, 0.005);
    }
  }
}

/// Two defects of each charge, in a periodic box: zeros of sin(2 pi (x - a) / L) + i sin(2 pi (y - b) / L).
FakeObserverContext four_defects(double a, double b) {
  auto context = lattice();
  const auto wave = [](double x) { return std::sin(2.0 * std::numbers::pi * x / edge); };
  context.set("order_tensor",
              {[=](double x, double) { return wave(x - a); }, [=](double, double y) { return wave(y - b); }});
  const double k = 2.0 * std::numbers::pi / edge;
  context.set("velocity", {[=](double x, double y) { return std::cos(k * (x - a)) * std::sin(k * (y - b)); },
                           [=](double x, double y) { return -std::sin(k * (x - a)) * std::cos(k * (y - b)); }});
  return context;
}

TEST(DefectFlow, GoesOnThroughTheFacesOfThePeriodicBox) {
  // The flow is the same in the frames of both +1/2, wherever the box is cut.
  auto inside = four_defects(0.305, 0.295);
  auto cut = four_defects(0.005, -0.005);
  const auto one = observer_with(inside).sample(inside);
  const auto other = observer_with(cut).sample(cut);
  EXPECT_EQ(one.at("count_plus")[0], 2.0);
  EXPECT_EQ(other.at("count_plus")[0], 2.0);
  for (const auto* name : {"plus", "minus"}) {
    for (std::size_t n = 0; n < one.at(name).size(); n += columns) {
      EXPECT_NEAR(one.at(name)[n + 2], other.at(name)[n + 2], 1e-9);
      EXPECT_NEAR(one.at(name)[n + 3], other.at(name)[n + 3], 1e-9);
    }
  }
}

TEST(DefectFlow, DefectsThatAreNotAloneAreLeftOut) {
  auto context = four_defects(0.305, 0.295);  // each 0.6 m from two of the other charge
  for (const double isolation : {0.58, 0.62}) {
    auto observer = observer_with(context, 0.2, 3);
    observer.set("isolation", isolation);
    const auto values = observer.sample(context);
    EXPECT_EQ(values.at("count_plus")[0], isolation < 0.6 ? 2.0 : 0.0);
    EXPECT_EQ(values.at("count_minus")[0], isolation < 0.6 ? 2.0 : 0.0);
    EXPECT_EQ(values.at("left_out")[0], isolation < 0.6 ? 0.0 : 4.0);
    EXPECT_EQ(std::isnan(values.at("plus")[2]), isolation > 0.6);
  }
}

TEST(DefectFlow, IsTheMeanOverSamples) {
  auto context = lattice();
  OneDefect defect = formula(0.5, 0.3);
  defect.give_to(context);
  auto tripled = context;
  defect.velocity = [](Complex z) { return 3.0 * flow(0.5, z); };
  defect.curl = [](Complex z) { return 3.0 * vorticity(0.5, z); };
  defect.give_to(tripled);
  const ObserverContextWith first(context, true);
  const ObserverContextWith second(tripled, true);
  auto observer = observer_with(first);
  const auto once = observer.sample(first);
  const auto mean = observer.sample(second);
  EXPECT_EQ(mean.at("count_plus")[0], 2.0);
  for (std::size_t n = 0; n < mean.at("plus").size(); n += columns) {
    for (std::size_t c = 2; c < columns; ++c) EXPECT_NEAR(mean.at("plus")[n + c], 2.0 * once.at("plus")[n + c], 1e-12);
  }
}

TEST(DefectFlow, ContinuesWhereItWasSaved) {
  auto context = four_defects(0.31, 0.27);
  context.set("velocity_gradient", {[](double x, double) { return x; }, [](double x, double) { return 2.0 * x; },
                                    [](double, double y) { return y; }, [](double x, double) { return -x; }});
  auto first = observer_with(context);
  (void)first.sample(context);
  const auto saved = first->save();
  auto second = observer_with(context);
  second->restore(saved);
  context.move([](double, double) { return 0.1; }, [](double, double) { return 0.02; });
  const auto expected = first.sample(context);
  EXPECT_EQ(expected.at("count_minus")[0], 4.0);
  EXPECT_EQ(second.sample(context), expected);
}

TEST(DefectFlow, OrderOfStorageDoesNotMatter) {
  auto context = lattice();
  context.jitter(0.3, 2);
  formula(0.5, 0.7).give_to(context);
  const ObserverContextWith walled(context, true);
  const auto before = observer_with(walled).sample(walled).at("plus");
  context.store_anew(6);
  const auto after = observer_with(walled).sample(walled).at("plus");
  ASSERT_EQ(after.size(), before.size());
  EXPECT_GT(std::count_if(before.begin(), before.end(), [](double x) { return !std::isnan(x); }), 100);
  for (std::size_t n = 0; n < before.size(); ++n) {
    const double wanted = std::isnan(before[n]) ? 0.0 : before[n];
    EXPECT_NEAR(std::isnan(after[n]) ? 0.0 : after[n], wanted, 1e-11) << n;
  }
}

TEST(DefectFlow, WithoutTheGradientThereIsNoVorticity) {
  auto context = four_defects(0.305, 0.295);
  const auto rows = observer_with(context).sample(context).at("plus");
  EXPECT_TRUE(std::isnan(rows[4]));
  EXPECT_FALSE(std::isnan(rows[2]));
}

TEST(DefectFlow, TheSquareIsAThirdOfTheShortestEdgeByItself) {
  FakeObserverContext context(60, 90, edge, 1.5 * edge);
  context.set("order_tensor", {[](double, double) { return 1.0; }, [](double, double) { return 0.0; }});
  context.set("velocity", {[](double, double) { return 1.0; }, [](double, double) { return 0.0; }});
  ObserverUnderTest observer("defect_flow");
  observer.start(context);
  const auto rows = observer.sample(context).at("plus");
  ASSERT_EQ(rows.size(), std::size_t{41} * 41 * columns);
  EXPECT_NEAR(rows[0], -0.2, 1e-15);
  EXPECT_TRUE(std::isnan(rows[2]));  // there are no defects
}

template <class Set>
std::string error_of(const Set& set) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {2.0, 1.0, 0.0};
  ObserverUnderTest observer("defect_flow");
  set(observer);
  try {
    observer.plan(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  return "no error";
}

TEST(DefectFlow, SaysWhatItRefuses) {
  EXPECT_EQ(error_of([](auto& observer) { observer.set("points", std::int64_t{40}); }),
            "defect_flow: `points` must be odd, so that the defect is at one of them, but is 40");
  EXPECT_EQ(error_of([](auto& observer) { observer.set("radius", std::optional<double>(0.75)); }),
            "defect_flow: `radius` is at most half the shortest edge of the box, 0.500000, but is 0.750000");
}

}  // namespace
}  // namespace mesogen::test
