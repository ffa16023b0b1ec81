#include "sph/fixed_weights.hpp"

// On a device nothing is to be gained: it computes a kernel faster than it reads a weight.
#ifndef __CUDACC__

#include <algorithm>

#include "mesogen/exec/sum_across.hpp"
#include "mesogen/sph/pair_sum.hpp"
#include "sph/passes/laplacian_loop.hpp"
#include "sph/passes/weighed_pairs.hpp"

namespace mesogen::sph {

namespace {

/// Weights of the pairs of a particle, by the places of their packs in its blocks.
template <class Real, int Dim, class Fit>
struct WeightLoop {
  using Lane = exec::Pack<Real>;
  using Source = WeighedPairs<Real, Dim>;
  static constexpr int group = int(Lane::size());
  Neighbours<Real, Dim> neighbours;
  Source source;
  Fit fit;
  Real* laplacian;
  Real* gradient[Dim];

  /// Of the n-th group of particles.
  void operator()(Index n) const {
    const Index first = n * group;
    const int members = std::min<Index>(group, neighbours.particle_count - first);
    typename Source::Kept kept;
    source.keep(first, members, kept);
    alignas(Lane) Real lanes[Fit::sum_count][group][group] = {};
    for (int k = 0; k < members; ++k) {
      Lane sum[Fit::sum_count] = {};
      source.visit(
          first, k, kept, [&](const auto& p, const auto&) __attribute__((always_inline)) { fit.add(p, sum); });
      for (int m = 0; m < Fit::sum_count; ++m) exec::store(sum[m], &lanes[m][k][0]);
    }
    Lane moments[Fit::sum_count];
    for (int m = 0; m < Fit::sum_count; ++m) exec::sum_across(lanes[m], moments[m]);
    Lane solved[Fit::weight_count];
    fit.solve(moments, solved);
    for (int k = 0; k < members; ++k) {
      Real weight[Fit::weight_count];
      for (int m = 0; m < Fit::weight_count; ++m) weight[m] = solved[m][static_cast<std::size_t>(k)];
      store_weights(first, k, kept, weight);
    }
  }

 private:
  void store_weights(Index first, int k, typename Source::Kept& kept, const Real* weight) const {
    Places places(neighbours, first + k);
    source.visit(
        first, k, kept, [&](const auto& p, const auto&) __attribute__((always_inline)) {
          const std::int64_t lane = places.next();
          Lane slope[Dim];
          for (int d = 0; d < Dim; ++d) slope[d] = p.slope * p.separation[d];
          if (laplacian != nullptr) exec::store(fit.laplacian(p, slope, weight), laplacian + lane);
          for (int a = 0; a < Dim; ++a) {
            if (gradient[a] == nullptr) continue;
            Lane component(Real(0));
            for (int b = 0; b < Dim; ++b) component += slope[b] * weight[Fit::correction + a * Dim + b];
            exec::store(component, gradient[a] + lane);
          }
        });
  }

  /// Where the weights of the packs of a particle lie, one after the other.
  class Places {
   public:
    Places(const Neighbours<Real, Dim>& grid, Index i) : grid_(grid), block_(grid.block_begin[i]) {}

    std::int64_t next() {
      const std::int64_t place = block_ * NeighbourBlock::width<Real> + lane_;
      lane_ += int(Lane::size());
      if (lane_ >= grid_.block[block_].lanes) {
        lane_ = 0;
        ++block_;
      }
      return place;
    }

   private:
    const Neighbours<Real, Dim>& grid_;
    std::int64_t block_;
    int lane_ = 0;
  };
};

/// All scalars of a particle while its weights are in the cache.
template <class Real, int Dim>
struct WeightedSums {
  using Lane = exec::Pack<Real>;
  Neighbours<Real, Dim> neighbours;
  const Real* laplacian;
  const Real* gradient[Dim];
  Derivatives<Real, Dim> wanted;

  void operator()(Index i) const {
    for (int n = 0; n < wanted.count; ++n) {
      const bool gradient_wanted = wanted.gradient[n][0] != nullptr;
      if (wanted.laplacian[n] != nullptr && gradient_wanted) {
        sum<true, true>(i, n);
      } else if (gradient_wanted) {
        sum<false, true>(i, n);
      } else {
        sum<true, false>(i, n);
      }
    }
  }

 private:
  template <bool Laplacian, bool Gradient>
  [[gnu::always_inline]] void sum(Index i, int n) const {
    const Real* const source = wanted.source[n];
    const Lane own(source[i]);
    Lane laplacian_sum(Real(0));
    Lane gradient_sum[Dim] = {};
    const std::int64_t end = neighbours.block_begin[i + 1];
    for (std::int64_t block = neighbours.block_begin[i]; block < end; ++block) {
      const NeighbourBlock& seen = neighbours.block[block];
      const std::int64_t at = block * NeighbourBlock::width<Real>;
      for (int lane = 0; lane < NeighbourBlock::width<Real>; lane += int(Lane::size())) {
        if (lane > 0 && lane >= seen.lanes) break;
        const Lane difference = Place<Lane>(seen, lane).load(source) - own;
        if constexpr (Laplacian) laplacian_sum += load(laplacian + at + lane) * difference;
        if constexpr (Gradient)
          exec::unroll<Dim>([&](auto d) { gradient_sum[d] += load(gradient[d] + at + lane) * difference; });
      }
    }
    if constexpr (Laplacian) wanted.laplacian[n][i] = exec::stdx::reduce(laplacian_sum);
    if constexpr (Gradient)
      exec::unroll<Dim>([&](auto d) { wanted.gradient[n][d][i] = exec::stdx::reduce(gradient_sum[d]); });
  }
};

template <class Real, int Dim, class Fit>
void find_weights_with(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel, const Fit& fit,
                       const WeightsWanted<Real>& wanted, FixedWeights<Real, Dim>& weights) {
  const auto room =
      static_cast<std::size_t>(neighbours.block_begin[neighbours.particle_count]) * NeighbourBlock::width<Real>;
  if (wanted.laplacian) weights.laplacian.resize(room);
  if (wanted.gradient)
    for (auto& gradient : weights.gradient) gradient.resize(room);
  with_kernel_function<Real>(kernel, [&](const auto& function) {
    const Pairs pairs(neighbours, function);
    WeightLoop<Real, Dim, Fit> loop{neighbours, WeighedPairs(pairs, wanted.volume), fit, nullptr, {}};
    if (!weights.laplacian.empty()) loop.laplacian = weights.laplacian.data();
    for (int d = 0; d < Dim; ++d)
      if (!weights.gradient[d].empty()) loop.gradient[d] = weights.gradient[d].data();
    exec::for_each({}, (neighbours.particle_count + loop.group - 1) / loop.group, loop);
  });
}

}  // namespace

template <class Real, int Dim>
void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                  const WeightsWanted<Real>& wanted, FixedWeights<Real, Dim>& weights) {
  if (wanted.consistent) {
    find_weights_with(neighbours, kernel, ConsistentFit<Real>{Real(kernel.smoothing_length)}, wanted, weights);
  } else {
    find_weights_with(neighbours, kernel, PlainFit<Real, Dim>{}, wanted, weights);
  }
}

template <class Real, int Dim>
void derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                 const FixedWeights<Real, Dim>& weights, const Derivatives<Real, Dim>& wanted) {
  const bool gradients = std::any_of(wanted.gradient, wanted.gradient + wanted.count,
                                     [](const auto& gradient) { return gradient[0] != nullptr; });
  if (!gradients) {
    return with_count(wanted.count, [&](auto number) {
      constexpr int count = number;
      std::array<const Real*, count> source;
      std::copy_n(wanted.source, count, source.begin());
      run_laplacians<Real, Dim, count>(neighbours, weights.laplacian.data(), source,
                                       [&wanted](Index first, int members, const auto& laplacian) {
                                         for (int c = 0; c < count; ++c)
                                           put(laplacian[c], wanted.laplacian[c] + first, members);
                                       });
    });
  }
  WeightedSums<Real, Dim> sums{neighbours, weights.laplacian.data(), {}, wanted};
  for (int d = 0; d < Dim; ++d) sums.gradient[d] = weights.gradient[d].data();
  exec::for_each(space, neighbours.particle_count, sums);
}

namespace {

template <class Real>
exec::Pack<Real> coefficient(const exec::ScaledCoefficient<Real>& scaled, Index first) {
  using Lane = exec::Pack<Real>;
  if (!scaled.scale) return Lane(scaled.number);
  return Lane(scaled.number) * (load(scaled.scale.component(0) + first) / Lane(scaled.usual));
}

/// The part of the latest increments along the axis, times its damping.
template <class Real, int Count>
exec::Pack<Real> along_axis(const exec::StageArguments<Real>& arguments, Index first) {
  using Lane = exec::Pack<Real>;
  Lane along(Real(0));
  for (int c = 0; c < Count; ++c)
    along += load(arguments.linear.axis.component(c) + first) * load(arguments.latest.component(c) + first);
  return along * coefficient(arguments.linear.damping_along_axis, first);
}

}  // namespace

template <class Real, int Dim>
void stage(const Neighbours<Real, Dim>& neighbours, const FixedWeights<Real, Dim>& weights,
           const exec::StageArguments<Real>& arguments) {
  with_count(arguments.components, [&](auto number) {
    constexpr int count = number;
    using Lane = exec::Pack<Real>;
    std::array<const Real*, count> source;
    for (int c = 0; c < count; ++c) source[c] = arguments.latest.component(c);
    run_laplacians<Real, Dim, count>(
        neighbours, weights.laplacian.data(), source,
        [&arguments](Index first, int members, const Lane(&laplacian)[count]) {
          const exec::LinearCoefficients<Real>& linear = arguments.linear;
          Lane share(Real(1));
          if (linear.divisor) share = Lane(Real(1)) / load(linear.divisor.component(0) + first);
          const Lane diffusion = coefficient(linear.diffusion, first);
          const Lane damping = coefficient(linear.damping, first);
          Lane along(Real(0));
          if (linear.axis) along = along_axis<Real, count>(arguments, first);
          for (int c = 0; c < count; ++c) {
            const Lane latest = load(arguments.latest.component(c) + first);
            Lane stiff = laplacian[c] * diffusion - latest * damping;
            if (linear.axis) stiff -= along * load(linear.axis.component(c) + first);
            put(arguments.next(latest, load<Real>(arguments.before.component(c) + first),
                               load(arguments.slope.component(c) + first), Lane(share * stiff)),
                arguments.before.component(c) + first, members);
          }
        });
  });
}

template void stage<float, 2>(const Neighbours<float, 2>&, const FixedWeights<float, 2>&,
                              const exec::StageArguments<float>&);
template void stage<double, 2>(const Neighbours<double, 2>&, const FixedWeights<double, 2>&,
                               const exec::StageArguments<double>&);
template void find_weights<float, 2>(const Neighbours<float, 2>&, const SmoothingKernel&, const WeightsWanted<float>&,
                                     FixedWeights<float, 2>&);
template void find_weights<double, 2>(const Neighbours<double, 2>&, const SmoothingKernel&,
                                      const WeightsWanted<double>&, FixedWeights<double, 2>&);
template void derivatives<float, 2>(const exec::Space&, const Neighbours<float, 2>&, const FixedWeights<float, 2>&,
                                    const Derivatives<float, 2>&);
template void derivatives<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const FixedWeights<double, 2>&,
                                     const Derivatives<double, 2>&);

}  // namespace mesogen::sph

#endif
