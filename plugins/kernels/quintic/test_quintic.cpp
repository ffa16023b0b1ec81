#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernel_checks.hpp"
#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen::test;
constexpr double pi = std::numbers::pi;

struct ClosedForm {
  template <class Number>
  Number operator()(const Number& q) const {
    const auto fifth = [](const auto& x) { return x * x * x * x * x; };
    return fifth(positive_part(3.0 - q)) - 6.0 * fifth(positive_part(2.0 - q)) + 15.0 * fifth(positive_part(1.0 - q));
  }
};

TEST(Quintic, EqualsTheClosedForm) { expect_closed_form("quintic", ClosedForm{}, 3.0); }

TEST(Quintic, HasTheKnownNormalisation) { expect_normalisation("quintic", 7.0 / (478.0 * pi), 1.0 / (120.0 * pi)); }

TEST(Quintic, IntegratesToOne) { expect_unit_integral("quintic"); }

TEST(Quintic, IsUsedInItsUnrolledForm) { expect_unrolled_form("quintic"); }

TEST(Quintic, GivesTheVolumeOnALattice) {
  mesogen::testing::TestScene scene;
  scene.arrangement = "lattice";
  mesogen::testing::PluginHarness harness(mesogen::PluginKind::kernel, "quintic", "", scene);
  double sum = 0.0;
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i) sum += ClosedForm{}(0.75 * std::hypot(i, j));  // h = 4/3 spacings
  const double h = 4.0 / 3.0 * 0.05;
  EXPECT_NEAR(harness.value("volume") / (h * h * 478.0 * pi / 7.0 / sum), 1.0, 1e-12);
}

}  // namespace
