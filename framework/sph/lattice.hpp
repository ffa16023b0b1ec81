#pragma once

#include "mesogen/export.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

/// What is known of the sums over neighbours on a square or cubic lattice.
namespace mesogen::sph {

/// The largest eigenvalue of minus the Laplacian, 1/m2: how fast it takes the shortest waves down. With weights
/// w = |W'| / r both forms are, up to normalisation, 2 Dim sum_j w r^p (f_j - f_i) / sum_j w r^(p + 2), p = 0 (plain)
/// and 2 (consistent: the fit of a quadratic, on a lattice). For quintic, h = 4/3 dx, Dim = 2: 3.9 / h^2 and 2.4 / h^2.
MESOGEN_EXPORT double largest_laplacian(const SmoothingKernel& kernel, double spacing, int dimension, bool consistent);

/// 1 / sum_j W_ij, m^Dim. With a kernel that reaches few neighbours it is not quite the volume that a particle fills.
MESOGEN_EXPORT double volume_on_lattice(const SmoothingKernel& kernel, double spacing, int dimension);

}  // namespace mesogen::sph
