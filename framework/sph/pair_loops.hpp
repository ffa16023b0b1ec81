#pragma once

#include "exec/backend.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::exec {

/// The framework's sums over neighbours; see sph/standard_passes.hpp.
template <class Real>
class PairLoops {
 public:
  PairLoops() = default;
  PairLoops(const PairLoops&) = delete;
  PairLoops& operator=(const PairLoops&) = delete;
  virtual ~PairLoops() = default;

  virtual void volumes(const Neighbours<Real, 2>& neighbours, const sph::SmoothingKernel& kernel,
                       FieldView<Real> volume) const = 0;
  virtual void derivatives(const Neighbours<Real, 2>& neighbours, const sph::SmoothingKernel& kernel,
                           const sph::Derivatives<Real, 2>& wanted) const = 0;
};

}  // namespace mesogen::exec
