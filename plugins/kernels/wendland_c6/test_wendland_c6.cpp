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
    const auto square = t * t;
    return square * square * square * square * (4.0 * q * q * q + 6.25 * q * q + 4.0 * q + 1.0);
  }
};

TEST(WendlandC6, EqualsTheClosedForm) { expect_closed_form("wendland_c6", ClosedForm{}, 2.0); }

TEST(WendlandC6, HasTheKnownNormalisation) {
  expect_normalisation("wendland_c6", 39.0 / (14.0 * pi), 1365.0 / (512.0 * pi));
}

TEST(WendlandC6, IntegratesToOne) { expect_unit_integral("wendland_c6"); }

TEST(WendlandC6, IsUsedInItsUnrolledForm) { expect_unrolled_form("wendland_c6"); }

}  // namespace
