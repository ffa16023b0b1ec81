#pragma once

#include "mesogen/exec/for_each.hpp"
#include "mesogen/exec/sum_across.hpp"
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

/// Sums for a group of particles, as many as a pack has lanes. Those of a particle stay in registers over all its
/// neighbours. Lanes are added up once, for the particles of a group together.
template <class Real, int Dim, class Kernel, class Pass>
struct PairLoop {
  using Lane = typename Pairs<Real, Dim, Kernel>::Lane;
  static constexpr int group = sizeof(Lane) / sizeof(Real);
  static constexpr int count = Pass::sum_count;
  Pairs<Real, Dim, Kernel> pairs;
  Pass pass;
  Index particles;

  /// The n-th group.
  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    if constexpr (group == 1) {
      const auto own = pass.load(n);
      Lane sums[count];
      sum(n, own, sums);
      pass.finish(n, own, sums);
    } else {
      sum_group(n * group);
    }
  }

 private:
  [[gnu::always_inline]] void sum_group(Index first) const {
    const int members = particles - first < group ? particles - first : group;
    alignas(Lane) Real lanes[count][group][group];
    for (int k = 0; k < members; ++k) {
      Lane sums[count];
      sum(first + k, pass.load(first + k), sums);
      exec::unroll<count>([&](auto c) __attribute__((always_inline)) { exec::store(sums[c], &lanes[c][k][0]); });
    }
    Real total[count][group];
    for (int c = 0; c < count; ++c) {
      for (int k = members; k < group; ++k)
        for (int lane = 0; lane < group; ++lane) lanes[c][k][lane] = Real(0);
      Lane pack;
      exec::sum_across(lanes[c], pack);
      exec::store(pack, total[c]);
    }
    for (int k = 0; k < members; ++k) {
      Real own[count];
      exec::unroll<count>([&](auto c) __attribute__((always_inline)) { own[c] = total[c][k]; });
      pass.finish(first + k, pass.load(first + k), own);
    }
  }

  template <class Own>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void sum(Index i, const Own& own, Lane (&sums)[count]) const {
    exec::unroll<count>([&](auto c) __attribute__((always_inline)) { sums[c] = Lane(Real(0)); });
    pairs.visit(
        i, [&](const auto& pair) __attribute__((always_inline)) { pass.pair(own, pair, &sums[0]); });
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
  using Loop = PairLoop<Real, Dim, Kernel, Pass>;
  const Index particles = neighbours.particle_count;
  exec::for_each(space, (particles + Loop::group - 1) / Loop::group,
                 Loop{Pairs<Real, Dim, Kernel>(neighbours, function), pass, particles}, "a sum over neighbours");
}

/// The same with the kernel of the run. The function of the kernel is the one choice made at run time.
template <class Real, int Dim, class Pass>
void pair_sum(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
              const Pass& pass) {
  with_kernel_function<Real>(kernel, [&](const auto& function) { pair_sum_with(space, neighbours, function, pass); });
}

}  // namespace mesogen::sph
