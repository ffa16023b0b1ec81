#include "sph/fixed_weights.hpp"

// On a device nothing is to be gained: it computes a kernel faster than it reads a weight.
#ifndef __CUDACC__

#include <algorithm>
#include <stdexcept>

#include "sph/passes/derivatives.hpp"
#include "sph/passes/laplacian_loop.hpp"

namespace mesogen::sph {

namespace {

/// Keeps the weights of the pairs of a particle by the places of their packs in its blocks. Trivially copyable.
template <class Real, int Dim>
class KeepWeights {
  using Lane = exec::Pack<Real>;

 public:
  static constexpr bool keeps = true;

  KeepWeights(const Neighbours<Real, Dim>& neighbours, FixedWeights<Real, Dim>& weights)
      : block_begin_(neighbours.block_begin), block_(neighbours.block) {
    if (!weights.laplacian.empty()) laplacian_ = weights.laplacian.data();
    for (int d = 0; d < Dim; ++d)
      if (!weights.gradient[d].empty()) gradient_[d] = weights.gradient[d].data();
  }

  class OfParticle {
   public:
    OfParticle(const KeepWeights& all, Index i) : all_(all), block_(all.block_begin_[i]) {}

    /// The weights of the next pack.
    template <class Fit>
    [[gnu::always_inline]] void take(const Fit& fit, const WeighedPair<Lane, Dim>& p, const Real* weight) {
      const std::int64_t at = next();
      Lane slope[Dim];
      for (int d = 0; d < Dim; ++d) slope[d] = p.slope * p.separation[d];
      if (all_.laplacian_ != nullptr) exec::store(fit.laplacian(p, slope, weight), all_.laplacian_ + at);
      for (int a = 0; a < Dim; ++a) {
        if (all_.gradient_[a] == nullptr) continue;
        Lane component(Real(0));
        for (int b = 0; b < Dim; ++b) component += slope[b] * weight[Fit::correction + a * Dim + b];
        exec::store(component, all_.gradient_[a] + at);
      }
    }

   private:
    [[gnu::always_inline]] std::int64_t next() {
      const std::int64_t place = block_ * NeighbourBlock::width<Real> + lane_;
      lane_ += int(Lane::size());
      if (lane_ >= all_.block_[block_].lanes) {
        lane_ = 0;
        ++block_;
      }
      return place;
    }

    const KeepWeights& all_;
    std::int64_t block_;
    int lane_ = 0;
  };

  [[nodiscard]] OfParticle of(Index i) const { return {*this, i}; }

 private:
  const std::int64_t* block_begin_;
  const NeighbourBlock* block_;
  Real* laplacian_ = nullptr;
  Real* gradient_[Dim] = {};
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
                       const Derivatives<Real, Dim>& wanted, FixedWeights<Real, Dim>& weights) {
  const Index particles = neighbours.particle_count;
  const KeepWeights<Real, Dim> keep(neighbours, weights);
  with_kernel_function<Real>(kernel, [&](const auto& function) {
    const Pairs pairs(neighbours, function);
    const WeighedPairs source(pairs, wanted.volume);
    const auto run = [&](auto number) {
      using Loop = DerivativeLoop<Real, Dim, number, Fit, WeighedPairs<Real, Dim>, KeepWeights<Real, Dim>>;
      exec::for_each({}, (particles + Loop::group - 1) / Loop::group, Loop(source, fit, wanted, particles, keep));
    };
    if (wanted.count == 4) return run(std::integral_constant<int, 4>());
    if (wanted.count == 2) return run(std::integral_constant<int, 2>());
    run(std::integral_constant<int, 0>());
  });
}

}  // namespace

template <class Real, int Dim>
void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel, const WeightsWanted& kinds,
                  const Derivatives<Real, Dim>& wanted, FixedWeights<Real, Dim>& weights) {
  if (!made_beside_weights(wanted.count)) throw std::logic_error("derivatives that are not made beside weights");
  const auto room =
      static_cast<std::size_t>(neighbours.block_begin[neighbours.particle_count]) * NeighbourBlock::width<Real>;
  if (kinds.laplacian) weights.laplacian.resize(room);
  if (kinds.gradient)
    for (auto& gradient : weights.gradient) gradient.resize(room);
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
template void find_weights<float, 2>(const Neighbours<float, 2>&, const SmoothingKernel&, const WeightsWanted&,
                                     const Derivatives<float, 2>&, FixedWeights<float, 2>&);
template void find_weights<double, 2>(const Neighbours<double, 2>&, const SmoothingKernel&, const WeightsWanted&,
                                      const Derivatives<double, 2>&, FixedWeights<double, 2>&);
template void derivatives<float, 2>(const exec::Space&, const Neighbours<float, 2>&, const FixedWeights<float, 2>&,
                                    const Derivatives<float, 2>&);
template void derivatives<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const FixedWeights<double, 2>&,
                                     const Derivatives<double, 2>&);

}  // namespace mesogen::sph

#endif
