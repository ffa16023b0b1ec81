#pragma once

#include "mesogen/exec/for_each.hpp"
#include "mesogen/sph/kernel_function.hpp"
#include "mesogen/sph/pairs.hpp"

/// Sums over neighbours. A pass is a small struct, written once for all lane types, for host and device:
///
///     struct MyPass {
///       static constexpr int sum_count = 2;                  // how many sums it makes
///       FieldView<const Real> volume, value;                 // what it reads
///       FieldView<Real> result;                              // what it writes
///       struct Own { Real value; };                          // what each pair needs of particle i
///       Own load(Index i) const;
///       template <class Pair, class Lane>
///       void pair(const Own& own, const Pair& p, Lane* sum) const;   // adds one pair (or a pack of pairs)
///       void finish(Index i, const Own& own, const Real* sum) const; // stores the result
///     };
///
/// The pair (i, i) is visited too, with separation exactly zero.
namespace mesogen::sph {

/// Sums for one particle. They stay in registers over all its neighbours, and their lanes are added up once.
template <class Real, int Dim, class Kernel, class Pass>
struct PairLoop {
  using Lane = typename Pairs<Real, Dim, Kernel>::Lane;
  Pairs<Real, Dim, Kernel> pairs;
  Pass pass;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const auto own = pass.load(i);
    Lane sums[Pass::sum_count];
    exec::unroll<Pass::sum_count>([&](auto n) { sums[n] = Lane(Real(0)); });
    pairs.visit(
        i, [&](const auto& pair) __attribute__((always_inline)) { pass.pair(own, pair, &sums[0]); });
    Real total[Pass::sum_count];
    exec::sum_lanes(sums, total);
    pass.finish(i, own, total);
  }
};

/// Two passes over the same pairs in one loop, with one distance per pair. Neither reads what the other writes.
template <class First, class Second>
struct FusedPass {
  static constexpr int sum_count = First::sum_count + Second::sum_count;
  First first;
  Second second;

  struct Own {
    decltype(First{}.load(0)) first;
    decltype(Second{}.load(0)) second;
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const { return {first.load(i), second.load(i)}; }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    first.pair(own.first, p, sum);
    second.pair(own.second, p, sum + First::sum_count);
  }

  template <class Real>
  MESOGEN_HOST_DEVICE void finish(Index i, const Own& own, const Real* sum) const {
    first.finish(i, own.first, sum);
    second.finish(i, own.second, sum + First::sum_count);
  }
};

/// Runs a pass for every particle of the box, with a given kernel function. Neighbours are summed in the order of
/// storage, so results do not depend on the number of threads.
template <class Real, int Dim, class Kernel, class Pass>
void pair_sum_with(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const Kernel& function,
                   const Pass& pass) {
  exec::for_each(space, neighbours.particle_count,
                 PairLoop<Real, Dim, Kernel, Pass>{Pairs<Real, Dim, Kernel>(neighbours, function), pass},
                 "a sum over neighbours");
}

/// The same with the kernel of the run. The function of the kernel is the one choice made at run time.
template <class Real, int Dim, class Pass>
void pair_sum(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
              const Pass& pass) {
  with_kernel_function<Real>(kernel, [&](const auto& function) { pair_sum_with(space, neighbours, function, pass); });
}

}  // namespace mesogen::sph
