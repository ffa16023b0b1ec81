#pragma once

#include <cstdint>

#include "mesogen/particles/field_view.hpp"
#include "mesogen/plugin/affine_rule.hpp"

/// Ghosts, wall particles and rules as loops see them. Trivially copyable.
///
/// Storage holds the particles of the fluid first, then those of walls, then ghosts.
namespace mesogen {

/// The images of the box whose particles may have ghosts.
struct Images {
  static constexpr int most = 26;
  int count = 0;
  int boxes[most][3];     ///< how many boxes away
  double shear[most][3];  ///< and how much farther, m: see Boundary::shear
};

/// Ghosts by place: each takes its values from a source and lies away from it by an offset.
struct GhostView {
  Index first = 0;  ///< place of the first one
  Index count = 0;
  const Index* source = nullptr;
  const std::uint8_t* image = nullptr;  ///< number among Images
  const double* offset[3] = {};         ///< m
  const double* origin[3] = {};         ///< of the tile of its cell, m
};

/// Particles of walls by place.
struct WallView {
  Index first = 0;
  Index count = 0;
  const double* position[3] = {};  ///< m
  const double* origin[3] = {};    ///< of the tile of its cell, m
};

/// Rules of one field, for images or for wall particles.
struct RuleView {
  int components = 0;
  bool diagonal = true;             ///< each component goes by itself
  const double* numbers = nullptr;  ///< null: all values stay the same

  [[nodiscard]] MESOGEN_HOST_DEVICE explicit operator bool() const { return numbers != nullptr; }
  /// Numbers per rule: matrix (its diagonal alone, if that is all), then summand.
  [[nodiscard]] static constexpr MESOGEN_HOST_DEVICE int size(int components, bool diagonal) {
    return components * (diagonal ? 2 : components + 1);
  }

  /// value = A value + b by the n-th rule.
  MESOGEN_HOST_DEVICE void apply(Index n, double* value) const {
    if (numbers == nullptr) return;
    const double* const rule = numbers + static_cast<std::ptrdiff_t>(n) * size(components, diagonal);
    if (diagonal) {
      for (int c = 0; c < components; ++c) value[c] = rule[c] * value[c] + rule[components + c];
      return;
    }
    double result[AffineRule::most];
    for (int r = 0; r < components; ++r) {
      result[r] = rule[components * components + r];
      for (int c = 0; c < components; ++c) result[r] += rule[r * components + c] * value[c];
    }
    for (int c = 0; c < components; ++c) value[c] = result[c];
  }
};

}  // namespace mesogen
