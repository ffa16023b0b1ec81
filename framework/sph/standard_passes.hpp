#pragma once

#include <string>

#include "mesogen/exec/for_each.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/sph/neighbours.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

/// The pair sums that several plugins need, offered by the framework. They live in a library of their own, built for
/// each instruction set.
namespace mesogen::sph {

/// What this build of the library is for: "baseline", "x86-64-v3" or "x86-64-v4".
MESOGEN_EXPORT std::string instruction_set();

/// V_i = 1 / sum_j W_ij, self included (m^Dim).
template <class Real, int Dim>
MESOGEN_EXPORT void volumes(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                            const SmoothingKernel& kernel, FieldView<Real> volume);

/// First and second derivatives of up to four scalars in one pass over the pairs.
///
/// alpha_i = sum_j V_j r_ji (x) grad_i W_ij, B_i = alpha_i^-1 (the correction). A singular alpha gives B = 1.
/// gradient:  B_i . sum_j V_j (f_j - f_i) grad_i W_ij, exact for linear f on any particles.
/// Laplacian: 2 (2 + Dim) / (2 + tr alpha_i) sum_j V_j (f_i - f_j) (r_ij . grad_i W_ij) / r_ij^2.
template <class Real, int Dim>
struct Derivatives {
  static constexpr int most = 4;

  FieldView<const Real> volume;
  bool consistent = false;  ///< the Laplacian of ConsistentFit
  int count = 0;
  const Real* source[most];    ///< components to differentiate
  Real* gradient[most][Dim];   ///< where d f / d x_d goes; nullptr: not wanted
  Real* laplacian[most];       ///< nullptr: not wanted
  FieldView<Real> correction;  ///< Dim x Dim; empty: not wanted
};

template <class Real, int Dim>
MESOGEN_EXPORT void derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                                const SmoothingKernel& kernel, const Derivatives<Real, Dim>& wanted);

/// Gradients alone, of one or two scalars, with a correction that `derivatives` has made where particles still are.
/// Each pair is visited once.
template <class Real, int Dim>
MESOGEN_EXPORT void gradients(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                              const SmoothingKernel& kernel, const Derivatives<Real, Dim>& wanted,
                              FieldView<const Real> correction);

}  // namespace mesogen::sph
