#pragma once

#include "exec/backend.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::exec {

/// The framework's sums over neighbours, for one dimension; see sph/standard_passes.hpp.
template <class Real, int Dim>
class PairLoopsIn {
 public:
  PairLoopsIn() = default;
  PairLoopsIn(const PairLoopsIn&) = delete;
  PairLoopsIn& operator=(const PairLoopsIn&) = delete;
  virtual ~PairLoopsIn() = default;

  /// How many runs the neighbours within `range` (m) of each particle make. For backends without code of the host.
  virtual void count_runs(const Neighbours<Real, Dim>& neighbours, double range, Index* number) const = 0;
  /// Writes these runs to `run`, those of a particle from neighbours.run_begin on.
  virtual void list_runs(const Neighbours<Real, Dim>& neighbours, double range, NeighbourRun* run) const = 0;
  virtual void volumes(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                       FieldView<Real> volume) const = 0;
  virtual void derivatives(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                           const sph::Derivatives<Real, Dim>& wanted) const = 0;
  virtual void gradients(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                         const sph::Derivatives<Real, Dim>& wanted, FieldView<const Real> correction) const = 0;
};

template <class Real, class Known>
class PairLoopsAmong;

template <class Real, int... Dims>
class PairLoopsAmong<Real, Dimensions<Dims...>> : public PairLoopsIn<Real, Dims>... {
 public:
  using PairLoopsIn<Real, Dims>::count_runs...;
  using PairLoopsIn<Real, Dims>::list_runs...;
  using PairLoopsIn<Real, Dims>::volumes...;
  using PairLoopsIn<Real, Dims>::derivatives...;
  using PairLoopsIn<Real, Dims>::gradients...;
};

/// The same for each dimension that Mesogen is built for.
template <class Real>
class PairLoops : public PairLoopsAmong<Real, BuiltDimensions> {};

}  // namespace mesogen::exec
