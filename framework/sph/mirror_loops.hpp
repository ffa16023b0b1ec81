#pragma once

#include "exec/backend.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "sph/mirror_runs.hpp"

namespace mesogen::exec {

/// Values at mirror points of walls by runs, for one dimension; see sph/mirror_runs.hpp. For backends without code of
/// the host.
template <class Real, int Dim>
class MirrorLoopsIn {
 public:
  MirrorLoopsIn() = default;
  MirrorLoopsIn(const MirrorLoopsIn&) = delete;
  MirrorLoopsIn& operator=(const MirrorLoopsIn&) = delete;
  virtual ~MirrorLoopsIn() = default;

  virtual void count_runs(const Neighbours<Real, Dim>& neighbours, const sph::MirrorPoints<Dim>& points, double range,
                          Index* number) const = 0;
  virtual void list_runs(const Neighbours<Real, Dim>& neighbours, const sph::MirrorPoints<Dim>& points, double range,
                         NeighbourRun* run) const = 0;
  virtual void count_rows(const sph::MirrorPoints<Dim>& points, Index* number) const = 0;
  virtual void find_weights(sph::MirrorFit fit, const Neighbours<Real, Dim>& neighbours,
                            const sph::MirrorPoints<Dim>& points, const sph::SmoothingKernel& kernel,
                            double* weight) const = 0;
  virtual void refresh(const sph::MirrorPoints<Dim>& points, const sph::MirrorWeights& weights,
                       const sph::CurvedValues& curved, const RuleView& rules, FieldView<Real> field, int components,
                       Index first) const = 0;
};

template <class Real, class Known>
class MirrorLoopsAmong;

template <class Real, int... Dims>
class MirrorLoopsAmong<Real, Dimensions<Dims...>> : public MirrorLoopsIn<Real, Dims>... {
 public:
  using MirrorLoopsIn<Real, Dims>::count_runs...;
  using MirrorLoopsIn<Real, Dims>::list_runs...;
  using MirrorLoopsIn<Real, Dims>::count_rows...;
  using MirrorLoopsIn<Real, Dims>::find_weights...;
  using MirrorLoopsIn<Real, Dims>::refresh...;
};

/// The same for each dimension that Mesogen is built for.
template <class Real>
class MirrorLoops : public MirrorLoopsAmong<Real, BuiltDimensions> {};

}  // namespace mesogen::exec
