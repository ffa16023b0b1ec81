#pragma once

#include <cmath>
#include <numbers>

#include "mesogen/export.hpp"

namespace mesogen::exec {

/// An angle as a number of quarter turns and a rest, for sines on a device: for large angles CUDA's own sine keeps an
/// array in local memory. Here 1 / pi has twice the digits of a double. So up to angles of 1e9 results are right to
/// about 2 units in the last place; where they are nearly 0, to 1e-32 of the angle. Beyond that they slowly lose
/// digits, and stay between -1 and 1.
class Angle {
 public:
  MESOGEN_HOST_DEVICE explicit Angle(double radians) {
    // Their sum is 1 / pi.
    constexpr double per_pi = 0x1.45f306dc9c883p-2;
    constexpr double rest_of_per_pi = -0x1.6b01ec5417056p-56;
    const double quarters = std::rint(2.0 * per_pi * radians);
    quadrant_ = quarters - 4.0 * std::floor(0.25 * quarters);
    rest_ = std::fma(radians, rest_of_per_pi, std::fma(radians, per_pi, -0.5 * quarters));
  }

  [[nodiscard]] MESOGEN_HOST_DEVICE double sine() const {
    const double size = is_odd() ? cosine_of_rest() : sine_of_rest();
    return quadrant_ < 2.0 ? size : -size;
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE double cosine() const {
    const double size = is_odd() ? sine_of_rest() : cosine_of_rest();
    return quadrant_ == 1.0 || quadrant_ == 2.0 ? -size : size;
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE double tangent() const {
    return is_odd() ? -cosine_of_rest() / sine_of_rest() : sine_of_rest() / cosine_of_rest();
  }

 private:
  [[nodiscard]] MESOGEN_HOST_DEVICE bool is_odd() const { return quadrant_ == 1.0 || quadrant_ == 3.0; }
  [[nodiscard]] MESOGEN_HOST_DEVICE double sine_of_rest() const {
#ifdef __CUDA_ARCH__
    return ::sinpi(rest_);
#else
    return std::sin(std::numbers::pi * rest_);
#endif
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE double cosine_of_rest() const {
#ifdef __CUDA_ARCH__
    return ::cospi(rest_);
#else
    return std::cos(std::numbers::pi * rest_);
#endif
  }

  double quadrant_;  // 0 to 3
  double rest_;      // in half turns, -1/4 to 1/4
};

/// What the host has, and by Angle on a device.
MESOGEN_HOST_DEVICE inline double sine(double radians) {
#ifdef __CUDA_ARCH__
  return Angle(radians).sine();
#else
  return std::sin(radians);
#endif
}
MESOGEN_HOST_DEVICE inline double cosine(double radians) {
#ifdef __CUDA_ARCH__
  return Angle(radians).cosine();
#else
  return std::cos(radians);
#endif
}
MESOGEN_HOST_DEVICE inline double tangent(double radians) {
#ifdef __CUDA_ARCH__
  return Angle(radians).tangent();
#else
  return std::tan(radians);
#endif
}

}  // namespace mesogen::exec
