#pragma once

#include "particles/field_loops.hpp"

/// The linear terms of a field, added to its rate or in a stage of a step.
namespace mesogen::exec {

/// What the linear terms of a field give at a particle, component by component.
template <class Real>
struct LinearAt {
  Real share, diffusion, damping, along_axis;

  template <int Components>
  static MESOGEN_HOST_DEVICE LinearAt of(const LinearCoefficients<Real>& linear, FieldView<const Real> field, Index i) {
    LinearAt at{linear.divisor ? Real(1) / linear.divisor(i) : Real(1), linear.diffusion(i), linear.damping(i),
                Real(0)};
    if (!linear.axis) return at;
    for (int c = 0; c < Components; ++c) at.along_axis += linear.axis(c, i) * field(c, i);
    at.along_axis *= linear.damping_along_axis(i);
    return at;
  }
  /// `axis`: the component of the axis, if there is one.
  MESOGEN_HOST_DEVICE Real operator()(Real laplacian, Real value, Real axis) const {
    return share * (laplacian * diffusion - value * damping - along_axis * axis);
  }
};

template <class Real, int Components>
struct AddLinear {
  LinearArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const auto linear = LinearAt<Real>::template of<Components>(a.linear, a.value, i);
    for (int c = 0; c < Components; ++c)
      a.rate(c, i) += linear(a.laplacian ? a.laplacian(c, i) : Real(0), a.value(c, i),
                             a.linear.axis ? a.linear.axis(c, i) : Real(0));
  }
};

template <class Real, int Components>
struct StageOfField {
  StageArguments<Real> a;
  FieldView<const Real> laplacian;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const auto linear = LinearAt<Real>::template of<Components>(a.linear, a.latest, i);
    for (int c = 0; c < Components; ++c)
      a.before(c, i) = a.next(
          a.latest(c, i), a.before(c, i), a.slope(c, i),
          linear(laplacian ? laplacian(c, i) : Real(0), a.latest(c, i), a.linear.axis ? a.linear.axis(c, i) : Real(0)));
  }
};

}  // namespace mesogen::exec
