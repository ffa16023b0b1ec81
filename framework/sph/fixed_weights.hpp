#pragma once

#include <array>
#include <vector>

#include "exec/large_pages.hpp"
#include "particles/field_loops.hpp"
#include "sph/standard_passes.hpp"

/// Derivatives for particles that keep still: the sums of `derivatives` with weights that are found once,
///
///     Laplacian of f = sum_j w_ij (f_j - f_i),   gradient of f = sum_j g_ij (f_j - f_i).
///
/// No distance, kernel or correction is computed again; what is left is limited by reading the weights from memory.
namespace mesogen::sph {

/// Weights by blocks of neighbours, lane by lane; those of lanes outside the support are zero.
template <class Real, int Dim>
struct FixedWeights {
  using Array = std::vector<Real, exec::LargePages<Real>>;
  Array laplacian;                  ///< 1/m^2; empty: not wanted
  std::array<Array, Dim> gradient;  ///< 1/m; empty: not wanted
};

/// Which weights are wanted.
struct WeightsWanted {
  bool laplacian = false;
  bool gradient = false;
};

/// Of how many scalars derivatives can be made while weights are found: those of a vector, of an order tensor, of both.
constexpr bool made_beside_weights(int scalars) { return scalars == 0 || scalars == 2 || scalars == 4; }

/// Finds the weights. In the same pass it makes the gradients and the correction that `derivatives` asks for, but no
/// Laplacians. Throws std::logic_error unless made_beside_weights(derivatives.count).
template <class Real, int Dim>
MESOGEN_EXPORT void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                                 const WeightsWanted& kinds, const Derivatives<Real, Dim>& derivatives,
                                 FixedWeights<Real, Dim>& weights);

/// One stage of a stabilised step, with the Laplacian of its latest increment.
template <class Real, int Dim>
MESOGEN_EXPORT void stage(const Neighbours<Real, Dim>& neighbours, const FixedWeights<Real, Dim>& weights,
                          const exec::StageArguments<Real>& arguments);

/// The same numbers as `derivatives`, but for rounding; no correction. The bits do not depend on the number of threads.
template <class Real, int Dim>
MESOGEN_EXPORT void derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                                const FixedWeights<Real, Dim>& weights, const Derivatives<Real, Dim>& wanted);

}  // namespace mesogen::sph
