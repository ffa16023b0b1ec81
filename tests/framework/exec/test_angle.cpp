// Sines as a device finds them: here with the same reduction, and the host's sine of what is left.

#include "exec/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesogen/exec/random.hpp"

namespace mesogen::exec {
namespace {

/// `slope`: by how much the result changes with the angle. What is not even a normal number may come out as 0.
void expect_near(double found, double expected, double units, double slope, double radians) {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  constexpr double smallest = std::numeric_limits<double>::min();
  EXPECT_NEAR(found, expected, units * unit * std::abs(expected) + 1e-32 * slope * std::abs(radians) + smallest)
      << "of " << radians;
}

void expect_right(double radians) {
  const Angle angle(radians);
  const double tangent = std::tan(radians);
  expect_near(angle.sine(), std::sin(radians), 2.0, 1.0, radians);
  expect_near(angle.cosine(), std::cos(radians), 2.0, 1.0, radians);
  expect_near(angle.tangent(), tangent, 4.0, 1.0 + tangent * tangent, radians);
}

TEST(Angle, HasTheSineOfTheHost) {
  for (const double size : {1e-300, 1e-3, 1.0, 10.0, 1e3, 1e6, 1e9})
    for (int i = 0; i < 20'000; ++i) expect_right(size * (2.0 * random_uniform(1, i, 0) - 1.0));
}

// Where the sine or the cosine is nearly 0 and has all its digits all the same.
TEST(Angle, IsRightBesideTheAxes) {
  for (int quarters = -2000; quarters <= 2000; ++quarters) {
    const double axis = quarters * (0.5 * std::numbers::pi);
    for (const double angle : {axis, std::nextafter(axis, 1e9), std::nextafter(axis, -1e9)}) expect_right(angle);
  }
}

TEST(Angle, LosesDigitsGently) {
  for (const double radians : {1e17, -3e30, 1e300, std::numeric_limits<double>::max()}) {
    EXPECT_LE(std::abs(Angle(radians).sine()), 1.0) << radians;
    EXPECT_LE(std::abs(Angle(radians).cosine()), 1.0) << radians;
  }
  EXPECT_NEAR(Angle(1e12).sine(), std::sin(1e12), 1e-15);
  EXPECT_TRUE(std::isnan(Angle(HUGE_VAL).sine()));
  EXPECT_TRUE(std::isnan(Angle(std::nan("")).cosine()));
}

}  // namespace
}  // namespace mesogen::exec
