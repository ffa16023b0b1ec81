#pragma once

#include <cmath>
#include <cstdint>

namespace mesogen {

/// Brings a coordinate (m) into [0, length) and counts in `images` the boxes that it crossed: coordinate + images *
/// length stays the same to rounding. A coordinate that is not finite, or a billion boxes away, is left as it is: the
/// checks of the run name the particle.
inline void wrap_into_box(double length, double& coordinate, std::int32_t& images) {
  if (coordinate >= 0.0 && coordinate < length) return;
  double boxes = std::floor(coordinate / length);
  if (!(std::abs(boxes) < 1e9)) return;
  double inside = coordinate - boxes * length;
  // Rounding can leave it just outside: -1e-18 m ends at `length` itself, which is the face at 0.
  if (inside < 0.0) {
    inside += length;
    boxes -= 1.0;
  }
  if (inside >= length) {
    inside -= length;
    boxes += 1.0;
  }
  coordinate = inside;
  images += static_cast<std::int32_t>(boxes);
}

}  // namespace mesogen
