#pragma once

#include "mesogen/exec/for_each.hpp"
#include "sph/pair_loops.hpp"
#include "sph/passes/neighbour_runs.hpp"

/// The framework's sums over neighbours, compiled twice: by g++ for the host, by nvcc for CUDA.
namespace mesogen::exec {

template <class Real, class Known>
class PairLoopsMade;

template <class Real>
class PairLoopsMade<Real, Dimensions<>> : public PairLoops<Real> {
 public:
  explicit PairLoopsMade(const Space& space) : space_(space) {}

 protected:
  Space space_;
};

/// Those of one dimension, on top of those of the others.
template <class Real, int Dim, int... Others>
class PairLoopsMade<Real, Dimensions<Dim, Others...>> : public PairLoopsMade<Real, Dimensions<Others...>> {
 public:
  using PairLoopsMade<Real, Dimensions<Others...>>::PairLoopsMade;

  void count_runs(const Neighbours<Real, Dim>& neighbours, double range, Index* number) const override {
    exec::for_each(this->space_, neighbours.particle_count,
                   sph::FindRuns<Real, Dim, false>{neighbours, Real(range * range), number, nullptr},
                   "counting neighbours");
  }
  void list_runs(const Neighbours<Real, Dim>& neighbours, double range, NeighbourRun* run) const override {
    exec::for_each(this->space_, neighbours.particle_count,
                   sph::FindRuns<Real, Dim, true>{neighbours, Real(range * range), nullptr, run}, "listing neighbours");
  }
  void volumes(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
               FieldView<Real> volume) const override {
    sph::volumes<Real, Dim>(this->space_, neighbours, kernel, volume);
  }
  void derivatives(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                   const sph::Derivatives<Real, Dim>& wanted) const override {
    sph::derivatives<Real, Dim>(this->space_, neighbours, kernel, wanted);
  }
  void gradients(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                 const sph::Derivatives<Real, Dim>& wanted, FieldView<const Real> correction) const override {
    sph::gradients<Real, Dim>(this->space_, neighbours, kernel, wanted, correction);
  }
};

template <class Real>
using PairLoopsImpl = PairLoopsMade<Real, BuiltDimensions>;

}  // namespace mesogen::exec
