#pragma once

#include <cstdint>

#include "mesogen/fields/field_view.hpp"

/// Wall particles and ghosts as loops see them. Trivially copyable.
///
/// Storage holds the particles of the fluid first, then those of walls, then ghosts, then what other ranks sent for
/// them.
namespace mesogen {

/// Ghosts by place: each takes its values from a source and lies away from it by an offset. A source is a particle of
/// this process, or, from number `own` on, one that another rank has (see Halo).
struct GhostView {
  Index first = 0;  ///< place of the first one
  Index count = 0;
  Index own = 0;  ///< particles of this process
  const Index* source = nullptr;
  const std::uint8_t* image = nullptr;  ///< number among Images
  const double* offset[3] = {};         ///< m
  const double* origin[3] = {};         ///< of the tile of its cell, m
  const double* of_others[3] = {};      ///< positions of sources that other ranks have, m

  /// Where fields hold the values of a ghost's source.
  [[nodiscard]] MESOGEN_HOST_DEVICE Index place_of_source(Index n) const {
    return source[n] < own ? source[n] : first + count + (source[n] - own);
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE double position_of_source(const double* of_own, int axis, Index n) const {
    return source[n] < own ? of_own[source[n]] : of_others[axis][source[n] - own];
  }
};

/// Particles of walls by place.
struct WallView {
  Index first = 0;
  Index count = 0;
  const double* position[3] = {};  ///< m
  const double* origin[3] = {};    ///< of the tile of its cell, m
};

}  // namespace mesogen
