#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mesogen/sph/smoothing_kernel.hpp"

/// What every kernel plugin must hold, checked on the library that the loader finds.
namespace mesogen::test {

/// A number and its derivative: arithmetic with it differentiates a formula exactly.
struct Dual {
  double value = 0.0;
  double slope = 0.0;

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator+(const Dual& a, double b) { return a + Dual{b}; }
  friend Dual operator-(double a, const Dual& b) { return Dual{a} - b; }
  friend Dual operator*(double a, const Dual& b) { return Dual{a} * b; }
};
inline Dual positive_part(const Dual& x) { return x.value > 0.0 ? x : Dual{}; }
inline double positive_part(double x) { return x > 0.0 ? x : 0.0; }

/// The shape of the kernel plugin of this name; a test failure if the framework would refuse it.
sph::KernelShape shape_of(const std::string& kernel);
/// 1 / integral over all space must be this, in two and three dimensions.
void expect_normalisation(const std::string& kernel, double in_2d, double in_3d);
/// The function that pair loops call, integrated by Gauss's rule, gives 1 in two and three dimensions.
void expect_unit_integral(const std::string& kernel);
/// The function that pair loops call is one of the unrolled forms, in float and in double, and equals the shape.
void expect_unrolled_form(const std::string& kernel);

/// Values and derivatives equal those of the formula `closed` at many points, within the support and beyond it.
template <class ClosedForm>
void expect_closed_form(const std::string& kernel, const ClosedForm& closed, double support) {
  const sph::KernelShape shape = shape_of(kernel);
  EXPECT_EQ(shape.support(), support);
  const double peak = closed(0.0);
  // Near q = 0 the powers of Wendland C6 are a hundred times larger than their sum: two digits are lost.
  constexpr int samples = 1000;
  for (int n = 0; n <= samples; ++n) {
    const double q = 1.25 * support * n / samples;
    const Dual expected = closed(Dual{q, 1.0});
    ASSERT_NEAR(shape.value(q), expected.value, 1e-13 * peak) << kernel << " at q = " << q;
    ASSERT_NEAR(shape.derivative(q), expected.slope, 1e-12 * peak) << kernel << ", derivative at q = " << q;
  }
}

}  // namespace mesogen::test
