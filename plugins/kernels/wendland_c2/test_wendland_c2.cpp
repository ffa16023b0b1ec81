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
    return t * t * t * t * (2.0 * q + 1.0);
  }
};

TEST(WendlandC2, EqualsTheClosedForm) { expect_closed_form("wendland_c2", ClosedForm{}, 2.0); }

TEST(WendlandC2, HasTheKnownNormalisation) {
  expect_normalisation("wendland_c2", 7.0 / (4.0 * pi), 21.0 / (16.0 * pi));
}

TEST(WendlandC2, IntegratesToOne) { expect_unit_integral("wendland_c2"); }

TEST(WendlandC2, IsUsedInItsUnrolledForm) { expect_unrolled_form("wendland_c2"); }

}  // namespace
