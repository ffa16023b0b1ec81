#include <gtest/gtest.h>

#include <numbers>

#include "kernel_checks.hpp"

namespace {

using namespace mesogen::test;
constexpr double pi = std::numbers::pi;

struct ClosedForm {
  template <class Number>
  Number operator()(const Number& q) const {
    const auto t = positive_part(1.0 - 0.5 * q);
    return t * t * t * t * t * t * (35.0 / 12.0 * q * q + 3.0 * q + 1.0);
  }
};

TEST(WendlandC4, EqualsTheClosedForm) { expect_closed_form("wendland_c4", ClosedForm{}, 2.0); }

TEST(WendlandC4, HasTheKnownNormalisation) {
  expect_normalisation("wendland_c4", 9.0 / (4.0 * pi), 495.0 / (256.0 * pi));
}

TEST(WendlandC4, IntegratesToOne) { expect_unit_integral("wendland_c4"); }

TEST(WendlandC4, IsUsedInItsUnrolledForm) { expect_unrolled_form("wendland_c4"); }

}  // namespace
