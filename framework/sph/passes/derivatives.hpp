#pragma once

#include "mesogen/exec/sum_across.hpp"
#include "mesogen/sph/pair_sum.hpp"
#include "sph/passes/fits.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

/// Visits the neighbours of a particle twice: for the moments that a fit needs, and with its weights for `Count`
/// scalars. So each visit keeps few sums, and they stay in registers. On the host a pack's distances and weights are
/// found before both and kept: short loops, so that a processor has several packs under way at a time. The weights of
/// fits are solved for a group of particles together, as many as a pack has lanes.
template <class Real, int Dim, int Count, class Fit, class Kernel>
class DerivativeLoop {
  using Lane = typename Pairs<Real, Dim, Kernel>::Lane;
  using Weighed = WeighedPair<Lane, Dim>;

 public:
  static constexpr int group = sizeof(Lane) / sizeof(Real);

  DerivativeLoop(const Pairs<Real, Dim, Kernel>& pairs, const Fit& fit, const Derivatives<Real, Dim>& wanted,
                 Index particles)
      : pairs_(pairs), fit_(fit), wanted_(wanted), particles_(particles) {}

  /// The n-th group.
  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    // A copy that nobody else knows of stays in registers whatever is written.
    const DerivativeLoop own = *this;
    own.run(n);
  }

 private:
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void run(Index n) const {
    const Index first = n * group;
    const int members = particles_ - first < group ? particles_ - first : group;
    Kept kept[group];
    Sums sums;
    for (int k = 0; k < members; ++k) {
      keep(first + k, kept[k]);
      find_moments(first + k, kept[k], sums, k);
    }
    Lane moment[Fit::sum_count];
    Lane weight[Fit::weight_count];
    sums.read(members, moment);
    fit_.solve(moment, weight);
    if (wanted_.correction)
      for (int c = 0; c < Dim * Dim; ++c) put(weight[Fit::correction + c], &wanted_.correction(c, first), members);
    if constexpr (Count > 0) {
      Weights weights(weight);
      for (int k = 0; k < members; ++k) sum_scalars(first + k, kept[k], weights.row[k], sums, k);
      Lane sum[scalar_sums];
      sums.read(members, sum);
      finish(sum, weight, first, members);
    }
  }

  static constexpr int per_scalar = Dim + 1;  // gradient and Laplacian
  static constexpr int scalar_sums = Count == 0 ? 1 : Count * per_scalar;
  // A device computes a pair faster than it fetches it; on the host it is twice what neighbours usually need.
  static constexpr int most_kept = group == 1 ? 1 : 256 / group;

  struct Kept {
    int packs;
    Index j[most_kept];
    struct {
      alignas(Lane) Real slope[group];
      Real separation[Dim][group];
    } pack[most_kept];
  };

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
      for (int n = 0; n < Number; ++n) {
        for (int k = members; k < group; ++k)
          for (int lane = 0; lane < group; ++lane) lanes[n][k][lane] = Real(0);
        exec::sum_across(lanes[n], sum[n]);
      }
    }
  };

  /// The weights of each particle of a group.
  struct Weights {
    Real row[group][Fit::weight_count];

    MESOGEN_HOST_DEVICE explicit Weights(const Lane* pack) {
      for (int n = 0; n < Fit::weight_count; ++n) {
        Real column[group];
        exec::store(pack[n], column);
        for (int k = 0; k < group; ++k) row[k][n] = column[k];
      }
    }
  };

  MESOGEN_HOST_DEVICE static void put(const Lane& pack, Real* to, int members) {
    if (members == group) return exec::store(pack, to);
    Real all[group];
    exec::store(pack, all);
    for (int k = 0; k < members; ++k) to[k] = all[k];
  }

  template <class Pair>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Weighed weighed(const Pair& pair) const {
    Weighed p;
    p.slope = pair.load(wanted_.volume) * pair.gradient();
    for (int d = 0; d < Dim; ++d) p.separation[d] = pair.separation[d];
    return p;
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void keep(Index i, Kept& kept) const {
    int packs = 0;
    if constexpr (group > 1) {
      pairs_.visit(
          i, [&](const auto& pair) __attribute__((always_inline)) {
            const Weighed p = weighed(pair);
            const int n = packs < most_kept ? packs : most_kept - 1;
            kept.j[n] = pair.j;
            exec::store(p.slope, &kept.pack[n].slope[0]);
            for (int d = 0; d < Dim; ++d) exec::store(p.separation[d], &kept.pack[n].separation[d][0]);
            ++packs;
          });
    }
    kept.packs = packs;
  }

  /// action(pair, j) for all packs of a particle.
  template <class Action>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void visit(Index i, const Kept& kept, const Action& action) const {
    if constexpr (group > 1) {
      if (kept.packs <= most_kept) {
        for (int n = 0; n < kept.packs; ++n) {
          Weighed p;
          exec::load(&kept.pack[n].slope[0], p.slope);
          for (int d = 0; d < Dim; ++d) exec::load(&kept.pack[n].separation[d][0], p.separation[d]);
          action(p, kept.j[n]);
        }
        return;
      }
    }
    pairs_.visit(
        i, [&](const auto& pair) __attribute__((always_inline)) { action(weighed(pair), pair.j); });
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void find_moments(Index i, const Kept& kept, Sums& sums, int k) const {
    Lane sum[Fit::sum_count];
    exec::unroll<Fit::sum_count>([&](auto n) { sum[n] = Lane(Real(0)); });
    visit(
        i, kept, [&](const Weighed& p, Index) __attribute__((always_inline)) { fit_.add(p, sum); });
    sums.set(k, sum);
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void sum_scalars(Index i, const Kept& kept, const Real* weight, Sums& sums,
                                                              int k) const {
    Real own[scalar_sums];
    Lane sum[scalar_sums];
    for (int n = 0; n < Count; ++n) own[n] = wanted_.source[n][i];
    exec::unroll<scalar_sums>([&](auto n) __attribute__((always_inline)) { sum[n] = Lane(Real(0)); });
    visit(
        i, kept, [&](const Weighed& p, Index j) __attribute__((always_inline)) { add(p, j, weight, own, sum); });
    sums.set(k, sum);
  }

  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void add(const Weighed& p, Index j, const Real* weight, const Real* own,
                                                      Lane* sum) const {
    Lane gradient[Dim];
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { gradient[d] = p.slope * p.separation[d]; });
    const Lane laplacian = fit_.laplacian(p, gradient, weight);
    exec::unroll<Count>([&](auto n) __attribute__((always_inline)) {
      Lane difference;
      exec::load(wanted_.source[n] + j, difference);
      difference = difference - Lane(own[n]);
      constexpr int at = n * per_scalar;
      exec::unroll<Dim>([&](auto d)
                            __attribute__((always_inline)) { sum[at + d] = sum[at + d] + gradient[d] * difference; });
      sum[at + Dim] = sum[at + Dim] + laplacian * difference;
    });
  }

  MESOGEN_HOST_DEVICE void finish(const Lane* sum, const Lane* weight, Index first, int members) const {
    for (int n = 0; n < Count; ++n, sum += per_scalar) {
      if (wanted_.laplacian[n] != nullptr) put(sum[Dim], wanted_.laplacian[n] + first, members);
      if (wanted_.gradient[n][0] == nullptr) continue;
      for (int a = 0; a < Dim; ++a) {
        Lane component(Real(0));
        for (int b = 0; b < Dim; ++b) component = component + weight[Fit::correction + a * Dim + b] * sum[b];
        put(component, wanted_.gradient[n][a] + first, members);
      }
    }
  }

  Pairs<Real, Dim, Kernel> pairs_;
  Fit fit_;
  Derivatives<Real, Dim> wanted_;
  Index particles_;
};

template <class Real, int Dim, int Count, class Fit>
void run_derivatives_with(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                          const SmoothingKernel& kernel, const Fit& fit, const Derivatives<Real, Dim>& wanted) {
  with_kernel_function<Real>(kernel, [&](const auto& function) {
    using Kernel = std::decay_t<decltype(function)>;
    using Loop = DerivativeLoop<Real, Dim, Count, Fit, Kernel>;
    exec::for_each(space, (neighbours.particle_count + Loop::group - 1) / Loop::group,
                   Loop({neighbours, function}, fit, wanted, neighbours.particle_count), "derivatives");
  });
}

template <class Real, int Dim, int Count>
void run_derivatives_of(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                        const SmoothingKernel& kernel, const Derivatives<Real, Dim>& wanted) {
  if constexpr (Count > 0) {
    if (wanted.consistent)
      return run_derivatives_with<Real, Dim, Count>(space, neighbours, kernel,
                                                    ConsistentFit<Real>{Real(kernel.smoothing_length)}, wanted);
  }
  run_derivatives_with<Real, Dim, Count>(space, neighbours, kernel, PlainFit<Real, Dim>{}, wanted);
}

template <class Real, int Dim>
void run_derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                     const Derivatives<Real, Dim>& wanted) {
  switch (wanted.count) {
    case 0: return run_derivatives_of<Real, Dim, 0>(space, neighbours, kernel, wanted);
    case 1: return run_derivatives_of<Real, Dim, 1>(space, neighbours, kernel, wanted);
    case 2: return run_derivatives_of<Real, Dim, 2>(space, neighbours, kernel, wanted);
    case 3: return run_derivatives_of<Real, Dim, 3>(space, neighbours, kernel, wanted);
    default: return run_derivatives_of<Real, Dim, 4>(space, neighbours, kernel, wanted);
  }
}

}  // namespace mesogen::sph
