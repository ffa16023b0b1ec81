#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sph/standard_passes.hpp"

/// Derivatives for particles that keep still: the sums of `derivatives` with weights that are found once,
///
///     Laplacian of f = sum_j w_ij (f_j - f_i),   gradient of f = sum_j g_ij (f_j - f_i).
///
/// No distance, kernel or correction is computed again; what is left is limited by reading the weights from memory.
namespace mesogen::sph {

/// Weights by blocks of neighbours that are stored behind each other; lanes of others have the weight zero.
template <class Real, int Dim>
struct FixedWeights {
  static constexpr int width = 8;  ///< lanes of a block

  std::vector<std::int64_t> begin;              ///< of each particle, its first block; one more at the end
  std::vector<Index> first;                     ///< of each block, the particle of its first lane
  std::vector<Real> laplacian;                  ///< by lane, 1/m^2; empty: not wanted
  std::array<std::vector<Real>, Dim> gradient;  ///< by lane, 1/m; empty: not wanted
};

/// Finds the weights for what `wanted` names, of which only volume, consistent, and which of gradients and Laplacians
/// are wanted at all counts. `stored`: particles and what lies beyond the faces.
template <class Real, int Dim>
MESOGEN_EXPORT void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                                 const Derivatives<Real, Dim>& wanted, Index stored, FixedWeights<Real, Dim>& weights);

/// The same numbers as `derivatives`, but for rounding; no correction. The bits do not depend on the number of threads.
template <class Real, int Dim>
MESOGEN_EXPORT void derivatives(const exec::Space& space, const FixedWeights<Real, Dim>& weights,
                                const Derivatives<Real, Dim>& wanted);

}  // namespace mesogen::sph
