#pragma once

#include "mesogen/sph/kernel_shape.hpp"

namespace mesogen::sph {

/// The kernel of a run: shape and smoothing length.
struct SmoothingKernel {
  KernelShape shape;
  double smoothing_length = 0.0;  ///< h, m
  double scale = 0.0;             ///< shape.normalisation(Dim) / h^Dim

  /// Radius beyond which the kernel is zero, m.
  [[nodiscard]] double radius() const { return shape.pieces.front().knot * smoothing_length; }
};

}  // namespace mesogen::sph
