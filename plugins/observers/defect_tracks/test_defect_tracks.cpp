#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "observer_context_with.hpp"

namespace mesogen::test {
namespace {

using Complex = std::complex<double>;  // a point; Q11 + i Q12
using Values = std::map<std::string, std::vector<double>, std::less<>>;

constexpr double edge = 1.0;
constexpr double spacing = 0.02;
constexpr double close = 0.02 * spacing;  // how well a defect is found, m

/// One row of `tracks`.
struct Row {
  double id, x, y, charge, orientation, vx, vy, age;
};

std::vector<Row> rows_of(const Values& values) {
  const auto& numbers = values.at("tracks");
  std::vector<Row> rows;
  for (std::size_t n = 0; n < numbers.size(); n += 8)
    rows.push_back({numbers[n], numbers[n + 1], numbers[n + 2], numbers[n + 3], numbers[n + 4], numbers[n + 5],
                    numbers[n + 6], numbers[n + 7]});
  return rows;
}

/// An observer of order tensors that a test gives as functions of the place: +1/2 where one is zero as z is, -1/2 where
/// it is zero as the conjugate of z.
class Watched {
 public:
  using Tensor = std::function<Complex(Complex)>;

  explicit Watched(bool walls, std::optional<double> max_displacement = 0.2)
      : walls_(walls), context_(50, 50, edge, edge), observer_("defect_tracks") {
    observer_.set("max_displacement", max_displacement);
    observer_.start(context_);
  }

  Values sample(double time, const Tensor& tensor) {
    context_.set("order_tensor", {[&](double x, double y) {
                                    return tensor({x, y}).real();
                                  },
                                  [&](double x, double y) {
                                    return tensor({x, y}).imag();
                                  }});
    return observer_.sample(ObserverContextWith(context_, walls_, time));
  }
  Observer* operator->() { return observer_.operator->(); }

 private:
  bool walls_;
  FakeObserverContext context_;
  ObserverUnderTest observer_;
};

Watched between_walls(std::optional<double> max_displacement = 0.2) { return Watched(true, max_displacement); }

/// A pair at (0.5 +- sqrt(square), 0.513), the +1/2 to the right; none where square < 0.
Watched::Tensor pair_with(double square) {
  return [=](Complex z) { return Complex(std::pow(z.real() - 0.5, 2) - square, z.imag() - 0.513); };
}

Watched::Tensor one_plus(Complex place, double orientation = 0.0) {
  return [=](Complex z) { return (z - place) * std::polar(1.0, orientation); };
}

Watched::Tensor two_plus(Complex one, Complex other) {
  return [=](Complex z) { return (z - one) * (z - other); };
}

TEST(DefectTracks, FollowsDefectsThroughTheFacesOfThePeriodicBox) {
  // Two defects of each charge, half an edge apart, all moving alike: 0.07 m along x and -0.11 m along y a second.
  Watched watched(false);
  const auto at = [](double time) {
    return [=](Complex z) {
      return Complex(std::sin(2.0 * std::numbers::pi * (z.real() - 0.313 - 0.07 * time)),
                     std::sin(2.0 * std::numbers::pi * (z.imag() - 0.287 + 0.11 * time)));
    };
  };
  const auto first = rows_of(watched.sample(0.0, at(0.0)));
  ASSERT_EQ(first.size(), 4U);
  for (const Row& row : first) {
    EXPECT_NEAR(std::remainder(row.x - 0.313, 0.5), 0.0, close);
    EXPECT_NEAR(std::remainder(row.y - 0.287, 0.5), 0.0, close);
    EXPECT_TRUE(std::isnan(row.vx) && std::isnan(row.vy));
    EXPECT_EQ(row.age, 0.0);
  }
  for (int n = 1; n <= 25; ++n) {
    const double time = 0.7 * n;
    const auto values = watched.sample(time, at(time));
    const auto rows = rows_of(values);
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(rows[i].id, static_cast<double>(i));
      EXPECT_EQ(rows[i].charge, first[i].charge);
      EXPECT_NEAR(rows[i].x, first[i].x + 0.07 * time, 2 * close);
      EXPECT_NEAR(rows[i].y, first[i].y - 0.11 * time, 2 * close);
      EXPECT_NEAR(rows[i].vx, 0.07, 2 * close / 0.7);
      EXPECT_NEAR(rows[i].vy, -0.11, 2 * close / 0.7);
      EXPECT_NEAR(rows[i].age, time, 1e-12);
    }
    EXPECT_NEAR(values.at("speed_plus")[0], std::hypot(0.07, 0.11), 2 * close / 0.7);
    EXPECT_NEAR(values.at("speed_minus")[0], std::hypot(0.07, 0.11), 2 * close / 0.7);
    EXPECT_EQ(values.at("created")[0] + values.at("annihilated")[0], 0.0);
    EXPECT_EQ(rows[0].x > edge, time > (edge - first[0].x) / 0.07);  // the path goes on through the face
  }
}

TEST(DefectTracks, VelocityAlongTheAxisIsAboveZeroTowardTheHead) {
  // A comet on a circle, its head ahead: the chord is parallel to the mean of the directions at its ends.
  auto watched = between_walls();
  constexpr double radius = 0.3;
  constexpr double turn = 0.25;  // rad a sample, of 0.5 s
  for (int n = 0; n < 20; ++n) {
    const double angle = turn * n;
    const double heading = angle + std::numbers::pi / 2.0;
    const auto tensor = one_plus(Complex(0.503, 0.497) + std::polar(radius, angle), heading + std::numbers::pi);
    // Q of a comet of orientation psi: e^(i (f + psi)), with f the polar angle: theta = f/2 + psi/2.
    const auto values = watched.sample(0.5 * n, tensor);
    const auto rows = rows_of(values);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_NEAR(std::remainder(rows[0].orientation - heading - std::numbers::pi, 2.0 * std::numbers::pi), 0.0, 1e-6);
    const double speed = values.at("axial_velocity_plus")[0];
    if (n == 0) {
      EXPECT_TRUE(std::isnan(speed));
      continue;
    }
    EXPECT_NEAR(speed, 2.0 * radius * std::sin(turn / 2.0) / 0.5, 1e-6);
    EXPECT_NEAR(values.at("speed_plus")[0], speed, 1e-6);
    EXPECT_TRUE(std::isnan(values.at("speed_minus")[0]));
  }
}

TEST(DefectTracks, APairThatAnnihilatesIsCounted) {
  // Half its distance squared falls as in the passive approach; the last sample that has it is that at t = 6 s.
  auto watched = between_walls();
  for (int n = 0; n <= 10; ++n) {
    const double square = 0.04 - 0.006 * n;
    const auto values = watched.sample(n, pair_with(square));
    const auto rows = rows_of(values);
    ASSERT_EQ(rows.size(), n <= 6 ? 2U : 0U) << n;
    for (const Row& row : rows) {
      // The average over the kernel adds its variance to (x - 0.5)^2, which brings the two together.
      EXPECT_NEAR(row.x, 0.5 + 2.0 * row.charge * std::sqrt(square), 0.15 * spacing);
      EXPECT_NEAR(row.y, 0.513, close);
      EXPECT_EQ(row.age, static_cast<double>(n));
    }
    EXPECT_EQ(values.at("deaths")[0], n == 7 ? 1.0 : 0.0);
    EXPECT_EQ(values.at("annihilated")[0], n >= 7 ? 1.0 : 0.0);
    EXPECT_EQ(values.at("births")[0], 0.0);
    if (n < 7) {
      EXPECT_TRUE(std::isnan(values.at("lifetime")[0]));
    } else {
      EXPECT_EQ(values.at("lifetime")[0], 6.0);
    }
  }
}

TEST(DefectTracks, APairThatIsCreatedIsCountedAndGetsNewIds) {
  // Two pairs one after the other: there from 2 to 4 s and from 7 to 8 s.
  auto watched = between_walls();
  for (int n = 0; n <= 10; ++n) {
    const bool first = n >= 2 && n <= 4;
    const bool second = n == 7 || n == 8;
    const auto values = watched.sample(n, pair_with(first || second ? 0.01 : -0.01));
    const auto rows = rows_of(values);
    ASSERT_EQ(rows.size(), first || second ? 2U : 0U) << n;
    if (second) {
      EXPECT_EQ(rows[0].id + rows[1].id, 5.0);  // 2 and 3
    }
    EXPECT_EQ(values.at("births")[0], n == 2 || n == 7 ? 1.0 : 0.0);
    EXPECT_EQ(values.at("deaths")[0], n == 5 || n == 9 ? 1.0 : 0.0);
  }
  const auto end = watched.sample(11.0, pair_with(-0.01));
  EXPECT_EQ(end.at("created")[0], 2.0);
  EXPECT_EQ(end.at("annihilated")[0], 2.0);
  EXPECT_EQ(end.at("lifetime")[0], 1.5);  // of 2 and of 1 s
}

TEST(DefectTracks, OppositeChargesThatCrossKeepTheirIdentity) {
  // Each comes to lie just where the other one was.
  auto watched = between_walls();
  const auto two = [](Complex plus, Complex minus) {
    return [=](Complex z) { return (z - plus) * std::conj(z - minus); };
  };
  const Complex left(0.433, 0.507);
  const Complex right(0.567, 0.507);
  const auto before = rows_of(watched.sample(0.0, two(left, right)));
  const auto after = rows_of(watched.sample(1.0, two(right, left)));
  ASSERT_EQ(before.size(), 2U);
  ASSERT_EQ(after.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(after[n].id, before[n].id);
    EXPECT_EQ(after[n].charge, before[n].charge);
    EXPECT_NEAR(after[n].vx, after[n].charge > 0.0 ? 0.134 : -0.134, 0.5 * spacing);
  }
}

TEST(DefectTracks, TheSumDecidesNotTheNearestOne) {
  // Both go 0.08 m to the right: the second is nearest to where the first one comes to be.
  auto watched = between_walls();
  (void)watched.sample(0.0, two_plus({0.413, 0.507}, {0.513, 0.507}));
  const auto rows = rows_of(watched.sample(1.0, two_plus({0.493, 0.507}, {0.593, 0.507})));
  ASSERT_EQ(rows.size(), 2U);
  for (const Row& row : rows) EXPECT_NEAR(row.vx, 0.08, 0.1 * spacing);
}

TEST(DefectTracks, FartherThanTheCutoffIsAnotherDefect) {
  for (const double cutoff : {0.29, 0.31}) {
    auto watched = between_walls(cutoff);
    (void)watched.sample(0.0, one_plus({0.353, 0.507}));
    const auto values = watched.sample(2.0, one_plus({0.653, 0.507}));
    EXPECT_EQ(values.at("births")[0], cutoff < 0.3 ? 1.0 : 0.0);
    EXPECT_EQ(values.at("deaths")[0], cutoff < 0.3 ? 1.0 : 0.0);
    EXPECT_EQ(rows_of(values).at(0).id, cutoff < 0.3 ? 1.0 : 0.0);
  }
}

TEST(DefectTracks, TheCutoffIsAQuarterOfTheMeanDistanceByItself) {
  // One defect in 1 m2: 0.25 m.
  for (const double way : {0.24, 0.26}) {
    auto watched = between_walls(std::nullopt);
    (void)watched.sample(0.0, one_plus({0.353, 0.507}));
    EXPECT_EQ(watched.sample(1.0, one_plus({0.353 + way, 0.507})).at("births")[0], way < 0.25 ? 0.0 : 1.0);
  }
}

TEST(DefectTracks, ContinuesWhereItWasSaved) {
  auto first = between_walls();
  for (int n = 0; n < 4; ++n) (void)first.sample(n, pair_with(n == 1 ? -0.01 : 0.02 + 0.001 * n));
  const auto saved = first->save();
  auto second = between_walls();
  second->restore(saved);
  for (int n = 4; n < 8; ++n) {
    const auto tensor = pair_with(n == 6 ? -0.01 : 0.02 + 0.001 * n);
    const auto expected = first.sample(n, tensor);
    const auto values = second.sample(n, tensor);
    ASSERT_EQ(values.size(), expected.size());
    for (const auto& [name, numbers] : expected) {
      ASSERT_EQ(values.at(name).size(), numbers.size()) << name;
      for (std::size_t i = 0; i < numbers.size(); ++i)
        EXPECT_TRUE(values.at(name)[i] == numbers[i] || (std::isnan(values.at(name)[i]) && std::isnan(numbers[i])))
            << name << " " << i;
    }
    if (n == 7) {
      EXPECT_EQ(values.at("created")[0], 2.0);
      EXPECT_EQ(values.at("lifetime")[0], 1.5);  // one of 0, one of 3 s
    }
  }
}

TEST(DefectTracks, ClosePairsAreLeftOut) {
  auto watched = between_walls();
  EXPECT_EQ(rows_of(watched.sample(0.0, pair_with(std::pow(1.2 * spacing, 2)))).size(), 2U);
  EXPECT_TRUE(rows_of(watched.sample(1.0, pair_with(std::pow(0.6 * spacing, 2)))).empty());
}

}  // namespace
}  // namespace mesogen::test
