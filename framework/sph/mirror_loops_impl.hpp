#pragma once

#include "sph/mirror_loops.hpp"

/// Values at mirror points of walls by runs, compiled twice: by g++ for a device that the host plays, by nvcc for CUDA.
namespace mesogen::exec {

template <class Real, class Known>
class MirrorLoopsMade;

template <class Real>
class MirrorLoopsMade<Real, Dimensions<>> : public MirrorLoops<Real> {
 public:
  explicit MirrorLoopsMade(const Space& space) : space_(space) {}

 protected:
  Space space_;
};

/// Those of one dimension, on top of those of the others.
template <class Real, int Dim, int... Others>
class MirrorLoopsMade<Real, Dimensions<Dim, Others...>> : public MirrorLoopsMade<Real, Dimensions<Others...>> {
 public:
  using MirrorLoopsMade<Real, Dimensions<Others...>>::MirrorLoopsMade;

  void count_runs(const Neighbours<Real, Dim>& neighbours, const sph::MirrorPoints<Dim>& points, double range,
                  Index* number) const override {
    sph::count_mirror_runs<Real, Dim>(this->space_, neighbours, points, range, number);
  }
  void list_runs(const Neighbours<Real, Dim>& neighbours, const sph::MirrorPoints<Dim>& points, double range,
                 NeighbourRun* run) const override {
    sph::list_mirror_runs<Real, Dim>(this->space_, neighbours, points, range, run);
  }
  void count_rows(const sph::MirrorPoints<Dim>& points, Index* number) const override {
    sph::count_mirror_rows<Dim>(this->space_, points, number);
  }
  void find_weights(sph::MirrorFit fit, const Neighbours<Real, Dim>& neighbours, const sph::MirrorPoints<Dim>& points,
                    const sph::SmoothingKernel& kernel, double* weight) const override {
    sph::find_mirror_weights<Real, Dim>(this->space_, fit, neighbours, points, kernel, weight);
  }
  void refresh(const sph::MirrorPoints<Dim>& points, const sph::MirrorWeights& weights, const sph::CurvedValues& curved,
               const RuleView& rules, FieldView<Real> field, int components, Index first) const override {
    sph::refresh_walls<Real, Dim>(this->space_, points, weights, curved, rules, field, components, first);
  }
};

template <class Real>
using MirrorLoopsImpl = MirrorLoopsMade<Real, BuiltDimensions>;

}  // namespace mesogen::exec
