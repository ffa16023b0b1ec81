#pragma once

#include <cmath>

/// What tests need that write a pair sum out, in a periodic square.
namespace mesogen::test {

/// Wendland C2 but for its factor, which cancels in weighted means; h: smoothing length.
inline double wendland_c2_shape(double distance, double h) {
  const double q = distance / h;
  return q < 2.0 ? std::pow(1.0 - q / 2.0, 4) * (2.0 * q + 1.0) : 0.0;
}

/// The separation from the nearest image, in a box of this length.
inline double nearest_image(double separation, double length) {
  return separation - length * std::round(separation / length);
}

}  // namespace mesogen::test
