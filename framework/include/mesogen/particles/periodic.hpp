#pragma once

#include <cmath>
#include <cstdint>

namespace mesogen {

/// Moves a coordinate (m) into [0, length), and adds to `images` the number of boxes by which it moved: coordinate +
/// images * length stays the same up to rounding. Leaves a coordinate unchanged that is not finite or is a billion
/// boxes away; the checks of the run then name the particle.
inline void wrap_into_box(double length, double& coordinate, std::int32_t& images) {
  if (coordinate >= 0.0 && coordinate < length) return;
  double boxes = std::floor(coordinate / length);
  if (!(std::abs(boxes) < 1e9)) return;
  double inside = coordinate - boxes * length;
  // Rounding can leave it just outside: -1e-18 m becomes `length` itself, which is the face at 0.
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
