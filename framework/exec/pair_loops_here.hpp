#pragma once

#include "exec/pair_loops.hpp"
#include "mesogen/exec/for_each.hpp"
#include "sph/standard_passes.hpp"

/// The loops over pairs as the compiler of this file makes them; see loops_here.hpp.
namespace mesogen::exec {

/// A class that offers PairLoops, with those of one dimension after the other made.
template <class Real, class Offer, class Known>
class PairLoopsHere;

template <class Real, class Offer>
class PairLoopsHere<Real, Offer, Dimensions<>> : public Offer {
 public:
  explicit PairLoopsHere(const Space& space) : space_(space) {}

 protected:
  Space space_;
};

template <class Real, class Offer, int Dim, int... Others>
class PairLoopsHere<Real, Offer, Dimensions<Dim, Others...>>
    : public PairLoopsHere<Real, Offer, Dimensions<Others...>> {
 public:
  using PairLoopsHere<Real, Offer, Dimensions<Others...>>::PairLoopsHere;

  void volumes(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
               FieldView<Real> volume) const override {
    sph::volumes<Real, Dim>(this->space_, neighbours, kernel, volume);
  }
  void derivatives(const Neighbours<Real, Dim>& neighbours, const sph::SmoothingKernel& kernel,
                   const sph::Derivatives<Real, Dim>& wanted) const override {
    sph::derivatives<Real, Dim>(this->space_, neighbours, kernel, wanted);
  }
};

}  // namespace mesogen::exec
