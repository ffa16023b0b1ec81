#include "mesogen/sph/kernel_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesogen/sph/kernel_function.hpp"

namespace {

using mesogen::sph::KernelShape;

KernelShape quintic() { return {.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}}, .power = 5}; }

TEST(KernelShape, UsableShapeHasNoProblem) {
  EXPECT_EQ(quintic().problem(), "");
  EXPECT_EQ(quintic().support(), 3.0);
}

TEST(KernelShape, SaysWhatIsWrong) {
  const auto expect = [](KernelShape shape, const std::string& problem) { EXPECT_EQ(shape.problem(), problem); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect({}, "it has no pieces");
  expect({.pieces = {{-1.0, {1.0}}}, .power = 5}, "a knot is not a positive number");
  expect({.pieces = {{nan, {1.0}}}, .power = 5}, "a knot is not a positive number");
  expect({.pieces = {{1.0, {1.0}}, {2.0, {1.0}}}, .power = 5}, "its knots do not fall");
  expect({.pieces = {{2.0, {}}}, .power = 5}, "a piece has no coefficients");
  expect({.pieces = {{2.0, {1.0, 2.0}}, {1.0, {1.0}}}, .power = 5}, "its pieces differ in the number of coefficients");
  expect({.pieces = {{2.0, {nan}}}, .power = 5}, "a coefficient is not finite");
  expect({.pieces = {{2.0, {1, 1, 1, 1, 1, 1, 1}}}, .power = 5}, "it has more than 6 pieces or 6 coefficients");
  expect({.pieces = {{2.0, {1.0}}}, .power = 2},
         "its lowest power is below 3, so its second derivative jumps at a knot");
  expect({.pieces = {{2.0, {-1.0}}}, .power = 5}, "it is not positive at q = 0");
  // (2-q)^3 alone has a slope at the centre.
  expect({.pieces = {{2.0, {1.0}}}, .power = 3}, "its slope at q = 0 is not zero");
  KernelShape rises = quintic();
  rises.pieces[2].coefficients[0] = -100.0;  // a hollow centre
  rises.pieces[1].coefficients[0] = 0.0;
  EXPECT_NE(rises.problem().find("it rises with q near q = 0."), std::string::npos) << rises.problem();
}

TEST(KernelShape, DerivativeIsTheSlopeOfTheValue) {
  const KernelShape shape = quintic();
  for (double q = 0.05; q < 3.2; q += 0.1) {
    constexpr double step = 1e-5;
    const double slope = (shape.value(q + step) - shape.value(q - step)) / (2.0 * step);
    EXPECT_NEAR(shape.derivative(q), slope, 1e-6);
  }
  EXPECT_EQ(shape.value(3.0), 0.0);
  EXPECT_EQ(shape.derivative(3.5), 0.0);
}

TEST(KernelShape, NormalisationInOneDimension) {
  EXPECT_NEAR(quintic().normalisation(1), 1.0 / 120.0, 1e-15);  // Morris, Fox & Zhu 1997
}

// A shape that has no unrolled form runs in the general one, to the same numbers.
template <class Unrolled>
void expect_general_agrees_with(const Unrolled& unrolled, const mesogen::sph::SmoothingKernel& kernel) {
  const mesogen::sph::GeneralKernelFunction<double> general(kernel);
  for (double r = 0.0; r < 1.0; r += 0.01) {
    EXPECT_NEAR(general.value(r), unrolled.value(r), 1e-13 * unrolled.value(0.0));
    EXPECT_NEAR(general.derivative(r), unrolled.derivative(r), 1e-12 * unrolled.value(0.0) / 0.3);
  }
}

TEST(KernelFunction, GeneralFormAgreesWithTheUnrolledOne) {
  const mesogen::sph::SmoothingKernel kernel{quintic(), 0.3, quintic().normalisation(2) / 0.09};
  expect_general_agrees_with(mesogen::sph::KernelFunction<double, 3, 1, 5>(kernel), kernel);
  expect_general_agrees_with(mesogen::sph::SplineFunction<double, 3, 5>(kernel), kernel);
}

TEST(SplineFunction, FitsShapesWhoseSignsAlternate) {
  using Spline = mesogen::sph::SplineFunction<double, 3, 5>;
  auto shape = quintic();
  EXPECT_TRUE(Spline::fits(shape));
  shape.pieces[1].coefficients[0] = 6.0;
  EXPECT_FALSE(Spline::fits(shape));
  shape = quintic();
  shape.pieces[2].coefficients.push_back(1.0);
  EXPECT_FALSE(Spline::fits(shape));
  shape = quintic();
  shape.power = 4;
  EXPECT_FALSE(Spline::fits(shape));
  shape = quintic();
  shape.pieces.pop_back();
  EXPECT_FALSE(Spline::fits(shape));
}

}  // namespace
