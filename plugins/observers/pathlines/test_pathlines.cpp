#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "fake_observer_context.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::test {
namespace {

using Ids = std::vector<double>;

FakeObserverContext box() { return {20, 10, 2.0, 1.0}; }

std::string error_of(ObserverUnderTest& observer, const Scene& scene) {
  try {
    observer.plan(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  return "no error";
}

TEST(Pathlines, FollowsParticlesThroughFacesAndThroughStorage) {
  auto context = box();
  ObserverUnderTest observer("pathlines");
  observer.set("particles", Ids{0, 199, 37});
  observer.start(context);
  for (unsigned step = 0; step < 30; ++step) {
    context.move([](double, double) { return 0.3; }, [](double, double) { return -0.4; });
    context.store_anew(step / 3);
    observer->follow(context);
  }
  const auto values = observer.sample(context);
  EXPECT_EQ(values.at("id"), (Ids{0, 199, 37}));
  const Ids start{0.05, 0.05, 1.95, 0.95, 1.75, 0.15};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(values.at("path")[2 * i], start[2 * i] + 9.0, 1e-12);
    EXPECT_NEAR(values.at("path")[2 * i + 1], start[2 * i + 1] - 12.0, 1e-12);
    EXPECT_NEAR(values.at("distance")[i], 15.0, 1e-12);
  }
}

TEST(Pathlines, DistanceIsTheLengthOfThePathNotOfItsEnds) {
  auto context = box();
  ObserverUnderTest observer("pathlines");
  observer.set("particles", Ids{7});
  observer.start(context);
  EXPECT_EQ(observer.number(context, "distance"), 0.0);
  constexpr int sides = 36;
  for (int step = 0; step < sides; ++step) {
    const double angle = 2 * std::numbers::pi * step / sides;
    context.move([=](double, double) { return 0.1 * std::cos(angle); },
                 [=](double, double) { return 0.1 * std::sin(angle); });
    observer->follow(context);
  }
  const auto values = observer.sample(context);
  EXPECT_NEAR(values.at("path")[0], 0.75, 1e-12);
  EXPECT_NEAR(values.at("path")[1], 0.05, 1e-12);
  EXPECT_NEAR(values.at("distance")[0], 3.6, 1e-12);
}

TEST(Pathlines, ContinuesWhereItWasSaved) {
  auto context = box();
  ObserverUnderTest first("pathlines");
  first.start(context);
  const auto step = [&](ObserverUnderTest& observer) {
    context.move([](double x, double y) { return 0.1 * std::sin(x + 2 * y); },
                 [](double x, double) { return 0.2 * x; });
    observer->follow(context);
  };
  step(first);
  step(first);
  const auto saved = first->save();
  context.store_anew(3);
  ObserverUnderTest second("pathlines");
  second.plan(context.scene());
  second->restore(saved);
  EXPECT_EQ(second.sample(context), first.sample(context));
  context.move([](double, double) { return 0.125; }, [](double, double) { return 0.0; });
  first->follow(context);
  second->follow(context);
  EXPECT_EQ(second.sample(context), first.sample(context));
  EXPECT_EQ(second->save(), first->save());
  EXPECT_GT(second.sample(context).at("distance")[0], 0.2);
}

TEST(Pathlines, EvenChoiceIsSpreadOverTheBox) {
  auto context = box();
  context.jitter(0.3, 1);
  ObserverUnderTest observer("pathlines");
  observer.set("count", std::int64_t{24});
  observer.start(context);
  const auto values = observer.sample(context);
  EXPECT_EQ((std::set<double>(values.at("id").begin(), values.at("id").end()).size()), 24U);
  int per_square[8] = {};  // of half a metre
  for (std::size_t i = 0; i < 24; ++i) {
    const int column = static_cast<int>(values.at("path")[2 * i] / 0.5);
    const int row = static_cast<int>(values.at("path")[2 * i + 1] / 0.5);
    ++per_square[std::clamp(4 * row + column, 0, 7)];
  }
  for (const int count : per_square) EXPECT_NEAR(count, 3, 1);
}

TEST(Pathlines, EveryParticleCanBeChosen) {
  const auto context = box();
  for (const auto* choice : {"even", "random"}) {
    ObserverUnderTest observer("pathlines");
    observer.set("count", std::int64_t{200});
    observer.set("choice", std::string(choice));
    observer.start(context);
    const auto ids = observer.sample(context).at("id");
    EXPECT_EQ((std::set<double>(ids.begin(), ids.end()).size()), 200U) << choice;
  }
}

TEST(Pathlines, RandomChoiceDependsOnTheSeedOnly) {
  auto context = box();
  const auto chosen = [&](std::int64_t seed) {
    ObserverUnderTest observer("pathlines");
    observer.set("choice", std::string("random"));
    observer.set("seed", seed);
    observer.start(context);
    return observer.sample(context).at("id");
  };
  const auto first = chosen(1);
  EXPECT_NE(chosen(2), first);
  context.store_anew(2);
  context.jitter(0.2, 3);
  EXPECT_EQ(chosen(1), first);
  EXPECT_EQ((std::set<double>(first.begin(), first.end()).size()), 16U);
}

TEST(Pathlines, AsksToFollowEveryStep) {
  ObserverUnderTest observer("pathlines");
  EXPECT_TRUE(observer.plan(box().scene()).follows());
  EXPECT_TRUE(observer.plan(box().scene()).read_list().empty());
}

TEST(Pathlines, RefusesParticlesThatDoNotExist) {
  const auto scene = box().scene();
  ObserverUnderTest observer("pathlines");
  observer.set("particles", Ids{3, 200});
  EXPECT_EQ(error_of(observer, scene), "pathlines: `particles` are whole numbers from 0 to 199, not 200");
  observer.set("particles", Ids{1.5});
  EXPECT_EQ(error_of(observer, scene), "pathlines: `particles` are whole numbers from 0 to 199, not 1.500000");
  observer.set("particles", Ids{4, 2, 4});
  EXPECT_EQ(error_of(observer, scene), "pathlines: `particles` names particle 4 more than once");
  observer.set("particles", Ids{});
  observer.set("count", std::int64_t{201});
  EXPECT_EQ(error_of(observer, scene), "pathlines: `count` is 201, but there are only 200 particles");
}

}  // namespace
}  // namespace mesogen::test
