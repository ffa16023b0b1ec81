#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "fake_observer_context.hpp"
#include "mesogen/diagnostics/error.hpp"

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
}

TEST(Mixing, OneColourCannotBeMixed) {
  FakeObserverContext context(20, 20, 1.0, 1.0);
  context.set("colour", {[](double, double) { return 1.0; }});
  EXPECT_TRUE(std::isnan(index_of(context)));
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

}  // namespace
}  // namespace mesogen::test
