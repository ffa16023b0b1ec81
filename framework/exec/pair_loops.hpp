#pragma once

#include "mesogen/neighbours/neighbours.hpp"
#include "mesogen/particles/dimensions.hpp"
#include "mesogen/particles/field_view.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen {

namespace sph {
template <class Real, int Dim>
struct Derivatives;
}

namespace exec {

/// The framework's loops over pairs of particles, for one dimension.
template <class Real, int Dim>
class PairLoopsIn {
 public:
  PairLoopsIn() = default;
  PairLoopsIn(const PairLoopsIn&) = delete;
  PairLoopsIn& operator=(const PairLoopsIn&) = delete;
  virtual ~PairLoopsIn() = default;

  virtual void volumes(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                       FieldView<Real> volume) const = 0;
  virtual void derivatives(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                           const sph::Derivatives<Real, Dim>& wanted) const = 0;
};

template <class Real, class Known>
class PairLoopsAmong;

template <class Real, int... Dims>
class PairLoopsAmong<Real, Dimensions<Dims...>> : public PairLoopsIn<Real, Dims>... {
 public:
  using PairLoopsIn<Real, Dims>::volumes...;
  using PairLoopsIn<Real, Dims>::derivatives...;
};

/// The same for each dimension that Mesogen is built for.
template <class Real>
using PairLoops = PairLoopsAmong<Real, BuiltDimensions>;

}  // namespace exec

}  // namespace mesogen
