#include "sph/passes/derivatives.hpp"

namespace mesogen::sph {

template <class Real, int Dim>
void derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                 const Derivatives<Real, Dim>& wanted) {
  run_derivatives(space, neighbours, kernel, wanted);
}

// One precision a file: each builds in half the time, side by side.
template void derivatives<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const SmoothingKernel&,
                                     const Derivatives<double, 2>&);

}  // namespace mesogen::sph
