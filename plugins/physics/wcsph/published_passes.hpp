#pragma once

// The density filter of the published scheme.

#include "mesogen/exec/for_each.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/passes.hpp"
#include "mesogen/sph/pair_sum.hpp"

namespace mesogen::wcsph {

/// Shepard filter (Ozbulut et al. 2020): c - beta sum_j (c_i - c_j) W_ij / sum_j W_ij. The pressure does not see what
/// it takes away, so nothing pushes back against it and it grows: see docs/stability.md.
template <class Real>
struct DensityFilter {
  static constexpr int sum_count = 2;
  enum Sum { weight, weighted_difference };

  FieldView<const Real> compression;
  FieldView<Real> filtered;
  Real beta;

  using Own = Real;
  MESOGEN_HOST_DEVICE Own load(Index i) const { return compression(i); }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane w = p.value();
    sum[weight] = sum[weight] + w;
    sum[weighted_difference] = sum[weighted_difference] + w * (p.load(compression) - Lane(own));
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own& own, const Real* sum) const {
    filtered(i) = own + beta * sum[weighted_difference] / sum[weight];
  }
};

/// Feeds the filtered density back: dc/dt gains (filtered - midpoint) / dt.
template <class Real>
struct Feedback {
  FieldView<const Real> filtered, midpoint;
  FieldView<Real> rate;
  Real per_step;

  MESOGEN_HOST_DEVICE void operator()(Index i) const { rate(i) += per_step * (filtered(i) - midpoint(i)); }
};

template <class Real, int Dim>
void add_density_filter(PassList& list, double beta) {
  list.field("compression_filtered", Rank::scalar).doc("rho / rho0 - 1 after the density filter");
  list.pass("density filter")
      .reads_neighbours({"compression_midpoint"})
      .writes({"compression_filtered"})
      .run([beta](const PassContext& context) {
        sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                      DensityFilter<Real>{context.read<Real>("compression_midpoint"),
                                          context.write<Real>("compression_filtered"), Real(beta)});
      });
}

template <class Real>
void add_filter_feedback(PassList& list) {
  list.pass("filter feedback")
      .reads({"compression_filtered", "compression_midpoint"})
      .accumulates({"compression_rate"})
      .run([](const PassContext& context) {
        const double dt = context.step_size();
        exec::for_each(
            context.space(), context.count(),
            Feedback<Real>{context.read<Real>("compression_filtered"), context.read<Real>("compression_midpoint"),
                           context.write<Real>("compression_rate"), Real(dt > 0.0 ? 1.0 / dt : 0.0)});
      });
}

}  // namespace mesogen::wcsph
