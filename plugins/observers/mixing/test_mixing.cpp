#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

#include "fake_observer_context.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "observer_context_with.hpp"

namespace mesogen::test {
namespace {

ObserverUnderTest started(const FakeObserverContext& context, std::optional<double> cells = std::nullopt) {
  ObserverUnderTest observer("mixing");
  observer.set("cells", cells);
  observer.start(context);
  return observer;
}

double index_of(const FakeObserverContext& context, std::optional<double> cells = std::nullopt) {
  return started(context, cells).number(context, "mixing_index");
}

/// Every particle put where another was.
void shuffle(FakeObserverContext& context, unsigned seed) {
  const auto x = context.position(0);
  const auto y = context.position(1);
  std::vector<std::size_t> place(x.size());
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), std::mt19937(seed));
  for (std::size_t i = 0; i < place.size(); ++i) context.place(i, x[place[i]], y[place[i]]);
}

TEST(Mixing, ApartAtTheStart) {
  for (const int n : {8, 20, 37, 64}) {
    for (const double ratio : {1.0, 0.5, 1.7}) {
      const FakeObserverContext context(n, static_cast<int>(n * ratio), 1.0, ratio);
      EXPECT_NEAR(index_of(context), 0.0, 1e-12) << n << " " << ratio;
    }
  }
}

TEST(Mixing, StaysApartWhenTheFluidMovesAsAWhole) {
  FakeObserverContext context(40, 40, 1.0, 1.0);
  auto observer = started(context);
  context.move([](double, double) { return 2.5; }, [](double, double) { return -0.5; });
  context.store_anew(4);
  EXPECT_NEAR(observer.number(context, "mixing_index"), 0.0, 1e-12);
}

TEST(Mixing, ARandomMixtureIsMixed) {
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    FakeObserverContext context(80, 80, 1.0, 1.0);
    auto observer = started(context);
    shuffle(context, seed);
    sum += observer.number(context, "mixing_index");
  }
  // Without the correction for finite samples, it would be 1 - 255/6399 = 0.96.
  EXPECT_GT(sum / 8, 0.99);
  EXPECT_LE(sum / 8, 1.0);
}

TEST(Mixing, EveryCellWithTheMeanColourIsMixed) {
  FakeObserverContext context(40, 40, 1.0, 1.0);
  std::vector<double> colour(1600);
  for (std::size_t i = 0; i < colour.size(); ++i) colour[i] = i % 2 == 0 && i / 40 % 2 == 0 ? 1.0 : 0.0;
  context.set_values("colour", colour);
  EXPECT_EQ(index_of(context, 4.0), 1.0);
}

TEST(Mixing, FormulaByHand) {
  // Four cells of 100 particles with 50, 25, 25 and 0 of colour 1: p = 1/4, s = 1/32, s0 = 3/16, sr = s0 3/399.
  FakeObserverContext context(20, 20, 1.0, 1.0);
  std::vector<double> colour(400, 0.0);
  const auto fill = [&](std::size_t x0, std::size_t y0, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) colour[(y0 + n / 10) * 20 + x0 + n % 10] = 1.0;
  };
  fill(0, 0, 50);
  fill(10, 0, 25);
  fill(0, 10, 25);
  context.set_values("colour", colour);
  EXPECT_NEAR(index_of(context, 2.0), (3.0 / 16 - 1.0 / 32) / (3.0 / 16 * (1 - 3.0 / 399)), 1e-14);
}

TEST(Mixing, TheFieldOfTheSceneIsUsedAsItIsNow) {
  FakeObserverContext context(20, 20, 1.0, 1.0);
  context.set("colour", {[](double x, double) { return x < 0.5 ? 1.0 : 0.0; }});
  auto observer = started(context, 2.0);
  EXPECT_EQ(observer.number(context, "mixing_index"), 0.0);
  context.set("colour", {[](double, double y) { return y < 0.5 ? 0.9 : 0.1; }});
  EXPECT_NEAR(observer.number(context, "mixing_index"), (0.25 - 0.16) / (0.25 * (1 - 3.0 / 399)), 1e-13);
  EXPECT_TRUE(observer->save().at("colour").empty());
}

TEST(Mixing, ContinuesWhereItWasSaved) {
  FakeObserverContext context(30, 30, 1.0, 1.0);
  auto first = started(context);
  context.move([](double, double y) { return 0.8 * std::sin(6.283185307179586 * y); },
               [](double, double) { return 0.1; });
  context.store_anew(9);
  ObserverUnderTest second("mixing");
  second.plan(context.scene());
  second->restore(first->save());
  const double index = first.number(context, "mixing_index");
  EXPECT_GT(index, 0.1);
  EXPECT_LT(index, 0.9);
  EXPECT_EQ(second.number(context, "mixing_index"), index);
  EXPECT_GT(first.number(context, "stretching"), 1.1);
  EXPECT_EQ(second.sample(context), first.sample(context));
  EXPECT_EQ(second->save(), first->save());
}

TEST(Mixing, OneColourCannotBeMixed) {
  FakeObserverContext context(20, 20, 1.0, 1.0);
  context.set("colour", {[](double, double) { return 1.0; }});
  EXPECT_TRUE(std::isnan(index_of(context)));
  EXPECT_EQ(started(context).number(context, "interface_length"), 0.0);
  EXPECT_TRUE(std::isnan(started(context).number(context, "stretching")));
}

TEST(Mixing, RefusesAnOddNumberOfCells) {
  ObserverUnderTest observer("mixing");
  observer.set("cells", std::optional<double>(5.0));
  try {
    observer.plan(FakeObserverContext(20, 20, 1.0, 1.0).scene());
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "mixing: `cells` must be an even number, so that the edges of the initial quarter are edges of cells, "
                 "but is 5.000000");
    EXPECT_EQ(error.code(), ExitCode::bad_case);
  }
}

double length_of(const ObserverContext& context) {
  ObserverUnderTest observer("mixing");
  observer.start(context);
  return observer.number(context, "interface_length");
}

FakeObserverContext::Function disc(double x0, double y0, double radius) {
  return [=](double x, double y) {  // in a box of one metre
    const double dx = x - x0 - std::round(x - x0);
    const double dy = y - y0 - std::round(y - y0);
    return std::hypot(dx, dy) < radius ? 1.0 : 0.0;
  };
}

TEST(MixingInterface, StripesAreExact) {
  for (const int n : {24, 40, 60}) {
    FakeObserverContext context(n, 30, 1.0, 30.0 / n);
    context.set("colour", {[](double x, double) { return x > 0.25 && x < 0.75 ? 1.0 : 0.0; }});
    EXPECT_NEAR(length_of(context), 2.0 * 30.0 / n, 1e-13) << n;
    EXPECT_NEAR(length_of(ObserverContextWith(context, true)), 2.0 * 30.0 / n, 1e-13) << "between walls, " << n;
    context.move([](double, double) { return 0.3; }, [](double, double) { return 0.0; });  // now one is at the face
    EXPECT_NEAR(length_of(context), 2.0 * 30.0 / n, 1e-13) << n;
  }
}

TEST(MixingInterface, OfTheQuarterAtTheStart) {
  for (const double ratio : {1.0, 0.6}) {
    for (const double disorder : {0.0, 0.2}) {
      FakeObserverContext context(100, static_cast<int>(100 * ratio), 1.0, ratio);
      context.jitter(disorder, 1);
      // A corner is rounded, and shorter by 0.87 spacings: of four here, of one between walls. 1.7 % in the square.
      EXPECT_NEAR(100.0 * (1.0 + ratio - length_of(context)), 4 * 0.87, 0.5) << ratio << " " << disorder;
      const ObserverContextWith walls(context, true);
      EXPECT_NEAR(100.0 * (0.5 + 0.5 * ratio - length_of(walls)), 0.87, 0.3) << ratio << " " << disorder;
    }
  }
}

TEST(MixingInterface, OfADisc) {
  const double circle = 2.0 * std::numbers::pi * 0.3;
  for (const double disorder : {0.0, 0.3}) {
    for (const double x0 : {0.5, 0.13, 0.0}) {  // within the box, across a face, across all faces
      FakeObserverContext context(80, 80, 1.0, 1.0);
      context.jitter(disorder, 2);
      context.set("colour", {disc(x0, x0 == 0.0 ? 0.0 : 0.52, 0.3)});
      EXPECT_NEAR(length_of(context) / circle, 1.0, 0.02) << x0 << " " << disorder;
    }
  }
}

TEST(MixingInterface, EndsAtWalls) {
  FakeObserverContext context(80, 80, 1.0, 1.0);
  context.set("colour", {disc(0.0, 0.0, 0.4)});
  EXPECT_NEAR(length_of(context) / (2.0 * std::numbers::pi * 0.4), 1.0, 0.01);
  // The same four arcs; but now nothing goes on across the faces.
  EXPECT_NEAR(length_of(ObserverContextWith(context, true)) / (2.0 * std::numbers::pi * 0.4), 1.0, 0.01);
  context.set("colour", {[](double x, double y) { return std::hypot(x, y) < 0.4 ? 1.0 : 0.0; }});
  EXPECT_NEAR(length_of(ObserverContextWith(context, true)) / (0.5 * std::numbers::pi * 0.4), 1.0, 0.01);
  EXPECT_NEAR(length_of(context) / (0.5 * std::numbers::pi * 0.4 + 0.8), 1.0, 0.025);
}

TEST(MixingInterface, ErrorFallsWithTheSquareOfTheSpacing) {
  const auto error = [](int n) {
    FakeObserverContext context(n, n, 1.0, 1.0);
    context.set("colour", {[](double x, double y) {  // as wide at each n: without grain
                  return 0.5 + 0.5 * std::tanh((0.3 - std::hypot(x - 0.5, y - 0.5)) / 0.1);
                }});
    return length_of(context) / (2.0 * std::numbers::pi * 0.3) - 1.0;
  };
  EXPECT_NEAR(error(60) / error(120), 4.0, 0.4);
  EXPECT_LT(std::abs(error(120)), 1e-3);
}

double length_of(const FakeObserverContext& context, double mesh_spacing) {
  ObserverUnderTest observer("mixing");
  observer.set("mesh_spacing", mesh_spacing);
  observer.start(context);
  return observer.number(context, "interface_length");
}

TEST(MixingInterface, CoarserNodesFeelLessOfTheGrainAndRoundMore) {
  FakeObserverContext context(160, 160, 1.0, 1.0);
  EXPECT_NEAR((2.0 - length_of(context, 3.0)) / (2.0 - length_of(context, 1.5)), 2.0, 0.2);
  context.jitter(0.3, 2);
  context.set("colour", {disc(0.5, 0.5, 0.3)});
  const double circle = 2.0 * std::numbers::pi * 0.3;
  EXPECT_NEAR(length_of(context, 1.0) / circle, 1.02, 0.005);
  EXPECT_NEAR(length_of(context, 1.5) / circle, 1.008, 0.002);
  EXPECT_NEAR(length_of(context, 2.0) / circle, 1.0035, 0.0015);
}

TEST(MixingInterface, ShearStretchesItAsItDoesALine) {
  FakeObserverContext context(60, 60, 1.0, 1.0);
  context.set("colour", {[](double x, double) { return x < 0.5 ? 1.0 : 0.0; }});
  auto observer = started(context);
  EXPECT_EQ(observer.number(context, "stretching"), 1.0);
  for (const double shear : {1.0, 2.0, 3.0}) {  // so often the box fits into itself
    context.move([](double, double y) { return y; }, [](double, double) { return 0.0; });
    context.store_anew(6);
    EXPECT_NEAR(observer.number(context, "stretching") / std::hypot(1.0, shear), 1.0, 0.005) << shear;
  }
}

TEST(MixingInterface, WhereFourColoursMeet) {
  FakeObserverContext context(100, 100, 1.0, 1.0);
  context.set("colour", {[](double x, double y) { return (x < 0.5) == (y < 0.5) ? 1.0 : 0.0; }});
  EXPECT_NEAR(length_of(context), 4.0, 0.08);
  // In the saddle of a plane wave product too, whatever the signs.
  context.set("colour", {[](double x, double y) {
                return 0.5 +
                       0.3 * std::cos(2.0 * std::numbers::pi * (x + y)) * std::cos(2.0 * std::numbers::pi * (x - y));
              }});
  EXPECT_NEAR(length_of(context), 4.0 * std::numbers::sqrt2, 0.03);
}

TEST(MixingInterface, NoneWhereThereAreNoParticles) {
  FakeObserverContext context(40, 40, 1.0, 1.0);
  context.set("colour", {[](double x, double) { return x < 0.5 ? 1.0 : 0.0; }});
  context.move([](double x, double) { return -0.5 * x; }, [](double, double) { return 0.0; });
  EXPECT_NEAR(length_of(context), 1.0, 1e-12) << "the other half of the box is empty";
}

}  // namespace
}  // namespace mesogen::test
