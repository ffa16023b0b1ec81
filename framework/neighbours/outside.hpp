#pragma once

#include "mesogen/exec/unroll.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// Is a particle in [0, box) along every axis? What is not a number is not.
MESOGEN_HOST_DEVICE inline bool is_inside(const double* const* position, const double* box, int dimension, Index i) {
  bool inside = true;
  for_axes(dimension, [&](auto d) { inside = inside && position[d][i] >= 0.0 && position[d][i] < box[d]; });
  return inside;
}

/// On the host: those that are not, in their order; returns how many they are.
inline Index find_outside(const double* const* position, const double* box, int dimension, Index count, Index* found) {
  Index number = 0;
  for (Index i = 0; i < count; ++i)
    if (!is_inside(position, box, dimension, i)) found[number++] = i;
  return number;
}

}  // namespace mesogen::exec
