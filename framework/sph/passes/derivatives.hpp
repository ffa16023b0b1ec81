#pragma once

#include "mesogen/sph/pair_sum.hpp"
#include "mesogen/sph/small_matrix.hpp"
#include "sph/passes/consistent_derivatives.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

/// Derivatives of `Count` scalars; see Derivatives for the formulas. All sums share g = V_j W'(r) / r.
template <class Real, int Dim, int Count>
struct DerivativePass {
  static constexpr int alpha = symmetric_components<Dim>;
  static constexpr int sum_count = alpha + Count * (1 + Dim);
  Derivatives<Real, Dim> wanted;

  struct Own {
    Real value[Count == 0 ? 1 : Count];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    Own own{};
    for (int n = 0; n < Count; ++n) own.value[n] = wanted.source[n][i];
    return own;
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane g = p.load(wanted.volume) * p.gradient();
    Lane weight[Dim];
    exec::unroll<Dim>([&](auto d) { weight[d] = g * p.separation[d]; });
    exec::unroll<Dim>([&](auto a) {
      exec::unroll<Dim - a>([&](auto offset) {
        constexpr int n = symmetric_index<Dim>(a, a + offset);
        sum[n] = sum[n] - weight[a] * p.separation[a + offset];
      });
    });
    exec::unroll<Count>([&](auto n) {
      constexpr int at = alpha + n * (1 + Dim);
      const Lane difference = p.load({wanted.source[n], 0}) - Lane(own.value[n]);
      sum[at] = sum[at] - difference * g;
      exec::unroll<Dim>([&](auto d) { sum[at + 1 + d] = sum[at + 1 + d] + difference * weight[d]; });
    });
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    Real inverse[Dim * Dim];
    invert_symmetric<Real, Dim>(sum, inverse);
    Real trace = Real(0);
    for (int d = 0; d < Dim; ++d) trace += sum[symmetric_index<Dim>(d, d)];
    const Real scale = Real(2 * (2 + Dim)) / (Real(2) + trace);
    const Real* s = sum + alpha;
    for (int n = 0; n < Count; ++n, s += 1 + Dim) {
      if (wanted.laplacian[n] != nullptr) wanted.laplacian[n][i] = scale * s[0];
      if (wanted.gradient[n][0] == nullptr) continue;
      for (int a = 0; a < Dim; ++a) {
        Real total = Real(0);
        for (int b = 0; b < Dim; ++b) total += inverse[a * Dim + b] * s[1 + b];
        wanted.gradient[n][a][i] = total;
      }
    }
    if (wanted.correction)
      for (int c = 0; c < Dim * Dim; ++c) wanted.correction(c, i) = inverse[c];
  }
};

template <class Real, int Dim, int Count>
void run_derivatives_of(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                        const SmoothingKernel& kernel, const Derivatives<Real, Dim>& wanted) {
  if constexpr (Count > 0) {
    if (wanted.consistent)
      return pair_sum<Real, Dim>(space, neighbours, kernel,
                                 ConsistentDerivativePass<Real, Dim, Count>{wanted, Real(kernel.smoothing_length)});
  }
  pair_sum<Real, Dim>(space, neighbours, kernel, DerivativePass<Real, Dim, Count>{wanted});
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
