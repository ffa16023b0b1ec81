#include "sph/fixed_weights.hpp"

// On a device nothing is to be gained: it computes a kernel faster than it reads a weight.
#ifndef __CUDACC__

#include "mesogen/sph/pair_sum.hpp"
#include "sph/passes/weighed_pairs.hpp"

namespace mesogen::sph {

namespace {

template <class Real, int Dim, class Fit, class Kernel>
struct WeightLoop {
  using Lane = exec::Pack<Real>;
  Neighbours<Real, Dim> neighbours;
  Pairs<Real, Dim, Kernel> pairs;
  Fit fit;
  FieldView<const Real> volume;
  Real* laplacian;
  Real* gradient[Dim];

  void operator()(Index i) const {
    Lane moments[Fit::sum_count] = {};
    pairs.visit(i, [&](const auto& pair) { fit.add(weighed<Real, Dim>(pair, volume), moments); });
    Real total[Fit::sum_count];
    exec::sum_lanes(moments, total);
    Real weight[Fit::weight_count];
    fit.solve(total, weight);
    const auto centre = pairs.place(i);
    for (std::int64_t block = neighbours.block_begin[i]; block < neighbours.block_begin[i + 1]; ++block) {
      pairs.visit_block(centre, neighbours.block[block], [&](int first, const auto& pair) {
        const auto p = weighed<Real, Dim>(pair, volume);
        const std::int64_t lane = block * NeighbourBlock::width<Real> + first;
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
  }
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
  [[gnu::always_inline]] static Lane load(const Real* from) {
    Lane lane;
    exec::load(from, lane);
    return lane;
  }

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
        const Lane difference = load(source + seen.first + lane) - own;
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
  const auto room =
      static_cast<std::size_t>(neighbours.block_begin[neighbours.particle_count]) * NeighbourBlock::width<Real>;
  for (int n = 0; n < wanted.count; ++n) {
    if (wanted.laplacian[n] != nullptr) weights.laplacian.resize(room);
    if (wanted.gradient[n][0] != nullptr)
      for (auto& gradient : weights.gradient) gradient.resize(room);
  }
  with_kernel_function<Real>(kernel, [&](const auto& function) {
    using Kernel = std::decay_t<decltype(function)>;
    WeightLoop<Real, Dim, Fit, Kernel> loop{neighbours, {neighbours, function}, fit, wanted.volume, nullptr, {}};
    if (!weights.laplacian.empty()) loop.laplacian = weights.laplacian.data();
    for (int d = 0; d < Dim; ++d)
      if (!weights.gradient[d].empty()) loop.gradient[d] = weights.gradient[d].data();
    exec::for_each({}, neighbours.particle_count, loop);
  });
}

}  // namespace

template <class Real, int Dim>
void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                  const Derivatives<Real, Dim>& wanted, FixedWeights<Real, Dim>& weights) {
  if (wanted.consistent) {
    find_weights_with(neighbours, kernel, ConsistentFit<Real>{Real(kernel.smoothing_length)}, wanted, weights);
  } else {
    find_weights_with(neighbours, kernel, PlainFit<Real, Dim>{}, wanted, weights);
  }
}

template <class Real, int Dim>
void derivatives(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                 const FixedWeights<Real, Dim>& weights, const Derivatives<Real, Dim>& wanted) {
  WeightedSums<Real, Dim> sums{neighbours, weights.laplacian.data(), {}, wanted};
  for (int d = 0; d < Dim; ++d) sums.gradient[d] = weights.gradient[d].data();
  exec::for_each(space, neighbours.particle_count, sums);
}

template void find_weights<float, 2>(const Neighbours<float, 2>&, const SmoothingKernel&, const Derivatives<float, 2>&,
                                     FixedWeights<float, 2>&);
template void find_weights<double, 2>(const Neighbours<double, 2>&, const SmoothingKernel&,
                                      const Derivatives<double, 2>&, FixedWeights<double, 2>&);
template void derivatives<float, 2>(const exec::Space&, const Neighbours<float, 2>&, const FixedWeights<float, 2>&,
                                    const Derivatives<float, 2>&);
template void derivatives<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const FixedWeights<double, 2>&,
                                     const Derivatives<double, 2>&);

}  // namespace mesogen::sph

#endif
