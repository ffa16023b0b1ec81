#pragma once

#include <string>

#include "case/case.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen {

/// What a scene's sums over neighbours need of them.
struct NeighbourNeeds {
  bool quadratic = false;  ///< a fit of second derivatives (kernel.laplacian = "consistent"), beside that of a gradient
  bool moving = false;     ///< particles move, and so lose their order
};

/// Why the kernel of a case reaches too few neighbours for the fits of derivatives, and from which smoothing length on
/// it reaches enough; empty if it does.
///
/// The fit at a particle inverts a matrix of moments: Dim x Dim for a gradient, one
/// more for second derivatives. Where
/// its determinant is below 1e-6 (sph/small_matrix.hpp) there are too few neighbours, or they lie in too few
/// directions, and the derivative is lost. Here the least determinant over the particles of a periodic patch of the
/// case's own arrangement is asked for, with a margin of ten. Particles that move are taken to be jittered by a quarter
/// of the spacing at least.
std::string neighbours_problem(const Case& source, const sph::SmoothingKernel& kernel, const NeighbourNeeds& needs);

}  // namespace mesogen
