#pragma once

#include <algorithm>

#include "mesogen/exec/sum_across.hpp"
#include "mesogen/sph/pair_sum.hpp"
#include "sph/passes/weighed_pairs.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

struct KeepNoWeights {
  static constexpr bool keeps = false;
};

/// Visits the neighbours of a particle twice: for the moments that a fit needs, and with its weights for `Count`
/// scalars. So each visit keeps few sums, and they stay in registers. The weights of fits are solved for a group of
/// particles together, as many as a pack has lanes. `Source`: WeighedPairs. `Keep`: what keeps the weights of a fit's
/// Laplacian and gradient for later sums; Laplacians are then not added up here.
template <class Real, int Dim, int Count, class Fit, class Source, class Keep = KeepNoWeights>
class DerivativeLoop : Keep {
  using Lane = typename Source::Lane;
  using Kept = typename Source::Kept;
  using Weighed = WeighedPair<Lane, Dim>;

 public:
  static constexpr int group = sizeof(Lane) / sizeof(Real);

  DerivativeLoop(const Source& source, const Fit& fit, const Derivatives<Real, Dim>& wanted, Index particles,
                 const Keep& keep = {})
      : Keep(keep), source_(source), fit_(fit), wanted_(wanted), particles_(particles) {}

  /// The n-th group.
  MESOGEN_HOST_DEVICE void operator()(Index n) const {
#ifdef __CUDACC__
    run(n);  // what a kernel is given lies in memory that it cannot write
#else
    // A copy that nobody else knows of stays in registers whatever is written.
    const DerivativeLoop own = *this;
    own.run(n);
#endif
  }

 private:
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void run(Index n) const {
    const Index first = n * group;
    const int members = group == 1 || particles_ - first >= group ? group : particles_ - first;
    Kept kept;
    Sums sums;
    source_.keep(first, members, kept);
    for (int k = 0; k < members; ++k) find_moments(first, k, kept, sums);
    Lane moment[Fit::sum_count];
    Lane weight[Fit::weight_count];
    sums.read(members, moment);
    fit_.solve(moment, weight);
    if (wanted_.correction)
      exec::unroll<Dim * Dim>(
          [&](auto c) { put(weight[Fit::correction + c], &wanted_.correction(c, first), members); });
    if constexpr (Count > 0 || Keep::keeps) {
      Weights weights(weight);
      const Correction correction(weight + Fit::correction);
      for (int k = 0; k < members; ++k) sum_scalars(first, k, kept, weights, sums);
      Lane sum[scalar_sums];
      sums.read(members, sum);
      Lane of_gradient[Dim * Dim];
      correction.read(of_gradient);
      finish(sum, of_gradient, first, members);
    }
  }

  static constexpr bool sums_laplacian = Fit::gives_laplacian && !Keep::keeps;
  static constexpr int per_scalar = Dim + (sums_laplacian ? 1 : 0);
  static constexpr int scalar_sums = Count == 0 ? 1 : Count * per_scalar;

  /// Sums of each particle of a group, lanes not added up yet.
  struct Sums {
    static constexpr int most = Fit::sum_count > scalar_sums ? Fit::sum_count : scalar_sums;
    alignas(Lane) Real lanes[most][group][group];

    template <int Number>
    [[gnu::always_inline]] MESOGEN_HOST_DEVICE void set(int k, const Lane (&sum)[Number]) {
      exec::unroll<Number>([&](auto n) __attribute__((always_inline)) { exec::store(sum[n], &lanes[n][k][0]); });
    }
    /// As packs over the group.
    template <int Number>
    MESOGEN_HOST_DEVICE void read(int members, Lane (&sum)[Number]) {
      exec::unroll<Number>([&](auto n) __attribute__((always_inline)) {
        for (int k = members; k < group; ++k)
          for (int lane = 0; lane < group; ++lane) lanes[n][k][lane] = Real(0);
        exec::sum_across(lanes[n], sum[n]);
      });
    }
  };

  /// The weights of each particle of a group.
  struct Weights {
    Real of[Fit::weight_count][group];

    MESOGEN_HOST_DEVICE explicit Weights(const Lane* pack) {
      exec::unroll<Fit::weight_count>([&](auto n) { exec::store(pack[n], of[n]); });
    }
  };

  /// Nobody reads it until all neighbours were visited. On a device it waits in shared memory: in registers it takes
  /// the room of sums, which the compiler then puts into local memory.
  class Correction {
   public:
    MESOGEN_HOST_DEVICE explicit Correction(const Lane* pack) {
      exec::unroll<Dim * Dim>([&](auto c) { at(c) = pack[c]; });
    }
    MESOGEN_HOST_DEVICE void read(Lane* pack) const {
      exec::unroll<Dim * Dim>([&](auto c) { pack[c] = at(c); });
    }

   private:
#ifdef __CUDA_ARCH__
    // Volatile, or the compiler keeps a copy in registers.
    __device__ static volatile Real& at(int c) {
      __shared__ volatile Real all[Dim * Dim][exec::LoopBlocks::size];
      return all[c][threadIdx.x];
    }
#else
    Lane& at(int c) { return of_[c]; }
    const Lane& at(int c) const { return of_[c]; }

    Lane of_[Dim * Dim];
#endif
  };

  MESOGEN_HOST_DEVICE static void put(const Lane& pack, Real* to, int members) {
    if (members == group) return exec::store(pack, to);
    Real all[group];
    exec::store(pack, all);
    for (int k = 0; k < members; ++k) to[k] = all[k];
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void find_moments(Index first, int k, Kept& kept, Sums& sums) const {
    Lane sum[Fit::sum_count];
    exec::unroll<Fit::sum_count>([&](auto n) { sum[n] = Lane(Real(0)); });
    source_.visit(
        first, k, kept, [&](const Weighed& p, const Place<Lane>&) __attribute__((always_inline)) { fit_.add(p, sum); });
    sums.set(k, sum);
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void sum_scalars(Index first, int k, Kept& kept, const Weights& weights,
                                                              Sums& sums) const {
    Real own[scalar_sums];
    Real weight[Fit::weight_count];
    exec::unroll<Fit::weight_count>([&](auto n) { weight[n] = weights.of[n][k]; });
    Lane sum[scalar_sums];
    exec::unroll<Count>([&](auto n) { own[n] = wanted_.source[n][first + k]; });
    exec::unroll<scalar_sums>([&](auto n) __attribute__((always_inline)) { sum[n] = Lane(Real(0)); });
    if constexpr (Keep::keeps) {
      auto keep = Keep::of(first + k);
      source_.visit(
          first, k, kept, [&](const Weighed& p, const Place<Lane>& place) __attribute__((always_inline)) {
            keep.take(fit_, p, weight);
            add(p, place, weight, own, sum);
          });
    } else {
      source_.visit(
          first, k, kept, [&](const Weighed& p, const Place<Lane>& place) __attribute__((always_inline)) {
            add(p, place, weight, own, sum);
          });
    }
    sums.set(k, sum);
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const Weighed& p, const Place<Lane>& place, const Real* weight,
                                                      const Real* own, Lane* sum) const {
    Lane gradient[Dim];
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { gradient[d] = p.slope * p.separation[d]; });
    Lane laplacian;
    if constexpr (sums_laplacian) laplacian = fit_.laplacian(p, gradient, weight);
    exec::unroll<Count>([&](auto n) __attribute__((always_inline)) {
      const Lane difference = place.load(wanted_.source[n]) - Lane(own[n]);
      constexpr int at = n * per_scalar;
      exec::unroll<Dim>([&](auto d)
                            __attribute__((always_inline)) { sum[at + d] = sum[at + d] + gradient[d] * difference; });
      if constexpr (sums_laplacian) sum[at + Dim] = sum[at + Dim] + laplacian * difference;
    });
  }

  MESOGEN_HOST_DEVICE void finish(const Lane* sum, const Lane* correction, Index first, int members) const {
    exec::unroll<Count>([&](auto n) {
      const Lane* const own = sum + n * per_scalar;
      if constexpr (sums_laplacian)
        if (wanted_.laplacian[n] != nullptr) put(own[Dim], wanted_.laplacian[n] + first, members);
      if (wanted_.gradient[n][0] == nullptr) return;
      exec::unroll<Dim>([&](auto a) {
        Lane component(Real(0));
        for (int b = 0; b < Dim; ++b) component = component + correction[a * Dim + b] * own[b];
        put(component, wanted_.gradient[n][a] + first, members);
      });
    });
  }

  Source source_;
  Fit fit_;
  Derivatives<Real, Dim> wanted_;
  Index particles_;
};

template <class Real, int Dim>
bool any_laplacian(const Derivatives<Real, Dim>& wanted) {
  return std::any_of(wanted.laplacian, wanted.laplacian + wanted.count, [](const Real* one) { return one != nullptr; });
}

template <class Real, int Dim, int Count, class Source>
void run_derivatives_of(const exec::Space& space, const Source& source, Index particles, Real smoothing_length,
                        const Derivatives<Real, Dim>& wanted) {
  const auto with_fit = [&](const auto& fit) {
    using Loop = DerivativeLoop<Real, Dim, Count, std::decay_t<decltype(fit)>, Source>;
    exec::for_each(space, (particles + Loop::group - 1) / Loop::group, Loop(source, fit, wanted, particles),
                   "derivatives");
  };
  // The fits differ in their Laplacians alone.
  if (!any_laplacian(wanted)) return with_fit(GradientFit<Real, Dim>{});
  if constexpr (Count > 0)
    wanted.consistent ? with_fit(ConsistentFit<Real>{smoothing_length}) : with_fit(PlainFit<Real, Dim>{});
}

template <class Real, int Dim>
void run_derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                     const Derivatives<Real, Dim>& wanted) {
  with_kernel_function<Real>(kernel, [&](const auto& function) {
    const Pairs pairs(neighbours, function);
    const WeighedPairs source(pairs, wanted.volume);
    const auto run = [&]<int count>() {
      run_derivatives_of<Real, Dim, count>(space, source, neighbours.particle_count, Real(kernel.smoothing_length),
                                           wanted);
    };
    switch (wanted.count) {
      case 0: return run.template operator()<0>();
      case 1: return run.template operator()<1>();
      case 2: return run.template operator()<2>();
      case 3: return run.template operator()<3>();
      default: return run.template operator()<4>();
    }
  });
}

}  // namespace mesogen::sph
