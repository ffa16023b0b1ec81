#include <gtest/gtest.h>

#include <numbers>

#include "kernel_checks.hpp"

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

}  // namespace
