#pragma once

#include <cstdint>

#include "mesogen/fields/field_view.hpp"

/// Wall particles and ghosts as loops see them. Trivially copyable.
///
/// Storage holds the particles of the fluid first, then those of walls, then ghosts.
namespace mesogen {

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

}  // namespace mesogen
