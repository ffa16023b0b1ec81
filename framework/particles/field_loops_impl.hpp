#pragma once

#include <cmath>
#include <stdexcept>

#include "exec/reductions.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "particles/field_loops.hpp"

/// The loops over fields, compiled twice: by g++ for the host, by nvcc for CUDA.
namespace mesogen::exec {

constexpr double most = 1.7976931348623157e308;

/// A comparison with NaN is false: what is not a number counts as infinite.
MESOGEN_HOST_DEVICE inline void raise(double& largest, double square) {
  if (!(square <= most)) {
    largest = HUGE_VAL;
  } else if (square > largest) {
    largest = square;
  }
}

/// Raises two: the squares of the value and of the rate.
template <class Real, int Components>
struct AdvanceField {
  AdvanceArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<2>& largest) const {
    double value_square = 0.0;
    double rate_square = 0.0;
    for (int c = 0; c < Components; ++c) {
      const auto slope = static_cast<double>(a.rate(c, i));
      const double value = a.from(c, i) + a.by * slope;
      a.exact(c, i) = value;
      a.rounded(c, i) = static_cast<Real>(value);
      value_square += value * value;
      rate_square += slope * slope;
    }
    raise(largest.value[0], value_square);
    raise(largest.value[1], rate_square);
  }
};

/// Raises above zero if the particle is nowhere.
template <class Real>
struct Move {
  MoveArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& nowhere) const {
    for (int d = 0; d < m.dimension; ++d) {
      double& at = m.position[d][i];
      at += m.by * m.velocity(d, i) + (m.shift ? m.shift_by * static_cast<double>(m.shift(d, i)) : 0.0);
      if (!(::fabs(at) <= most)) nowhere.value[0] = 1.0;
    }
  }
};

template <class Real>
struct MoveByPasses {
  MoveByPassesArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& nowhere) const {
    for (int d = 0; d < m.dimension; ++d) {
      double& at = m.position[d][i];
      if (m.to_midpoint) {
        m.way(d, i) = m.step_size / 2.0 * static_cast<double>(m.velocity(d, i));
        at += m.way(d, i);
      } else {
        const double speed =
            static_cast<double>(m.velocity(d, i)) + (m.shift ? static_cast<double>(m.shift(d, i)) : 0.0);
        at += m.step_size * speed - m.way(d, i);
      }
      if (!(::fabs(at) <= most)) nowhere.value[0] = 1.0;
    }
  }
};

template <class Real>
struct SquaredLength {
  FieldView<const Real> field;
  int components;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& largest) const {
    double square = 0.0;
    for (int c = 0; c < components; ++c) {
      const auto value = static_cast<double>(field(c, i));
      square += value * value;
    }
    raise(largest.value[0], square);
  }
};

template <class Real>
struct SquaredChange {
  FieldView<const Real> velocity;
  FieldView<const double> way;
  double per_half_step;
  int components;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& largest) const {
    double square = 0.0;
    for (int c = 0; c < components; ++c) {
      const double change = static_cast<double>(velocity(c, i)) - per_half_step * way(c, i);
      square += change * change;
    }
    raise(largest.value[0], square);
  }
};

/// Raises above zero if a value is outside the bounds or not a number.
template <class Real>
struct ValueOutside {
  FieldView<const Real> field;
  Real lowest, highest;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& outside) const {
    if (!(field(i) >= lowest) || !(field(i) <= highest)) outside.value[0] = 1.0;
  }
};

/// The same of a vector's length.
template <class Real>
struct LengthOutside {
  FieldView<const Real> field;
  int components;
  Real lowest, highest;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& outside) const {
    Real square(0);
    for (int c = 0; c < components; ++c) square += field(c, i) * field(c, i);
    if (!(square <= highest * highest) || (lowest > Real(0) && !(square >= lowest * lowest))) outside.value[0] = 1.0;
  }
};

template <class T>
struct Zero {
  FieldView<T> field;
  int components;
  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < components; ++c) field(c, i) = T(0);
  }
};

/// What particles see that move relative to the fluid.
template <class Real, int Dim>
struct Advect {
  AdvectArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < a.components; ++c) {
      Real change = Real(0);
      for (int d = 0; d < Dim; ++d) change += a.velocity(d, i) * a.gradient(c * Dim + d, i);
      a.rate(c, i) += a.sign * change;
    }
  }
};

template <class Real>
struct AddLinear {
  LinearArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real share = a.divisor ? Real(1) / a.divisor(i) : Real(1);
    for (int c = 0; c < a.components; ++c) {
      const Real spread = a.laplacian ? a.diffusion * a.laplacian(c, i) : Real(0);
      a.rate(c, i) += share * (spread - a.damping * a.value(c, i));
    }
  }
};

template <class Real>
struct StageOfField {
  StageArguments<Real> a;
  FieldView<const Real> laplacian;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real share = a.divisor ? Real(1) / a.divisor(i) : Real(1);
    for (int c = 0; c < a.components; ++c)
      a.before(c, i) =
          a.next(a.latest(c, i), a.before(c, i), a.slope(c, i), laplacian ? laplacian(c, i) : Real(0), share);
  }
};

template <class Real>
struct ScaleField {
  FieldView<const Real> from;
  Real factor;
  FieldView<Real> to;
  int components;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < components; ++c) to(c, i) = factor * from(c, i);
  }
};

template <class Real>
class FieldLoopsImpl final : public FieldLoops<Real> {
 public:
  FieldLoopsImpl(const Space& space, Reductions& reductions) : space_(space), reductions_(reductions) {}

  void zero(FieldView<Real> field, int components, Index count) const override {
    for_each(space_, count, Zero<Real>{field, components}, "zeroing a field");
  }
  void advect(const AdvectArguments<Real>& arguments, Index count) const override {
    dispatch(arguments.dimension,
             [&]<int Dim>() { for_each(space_, count, Advect<Real, Dim>{arguments}, "advection"); });
  }
  void add_linear(const LinearArguments<Real>& arguments, Index count) const override {
    for_each(space_, count, AddLinear<Real>{arguments}, "linear terms");
  }
  void stage(const StageArguments<Real>& arguments, FieldView<const Real> laplacian, Index count) const override {
    for_each(space_, count, StageOfField<Real>{arguments, laplacian}, "a stage of a step");
  }
  void scale(FieldView<const Real> from, Real factor, FieldView<Real> to, int components, Index count) const override {
    for_each(space_, count, ScaleField<Real>{from, factor, to, components}, "scaling a field");
  }
  Reduction advance(const AdvanceArguments<Real>& arguments, Index count) const override {
    switch (arguments.components) {
      case 1: return advance_of<1>(arguments, count);
      case 2: return advance_of<2>(arguments, count);
      case 3: return advance_of<3>(arguments, count);
      case 4: return advance_of<4>(arguments, count);
      case 5: return advance_of<5>(arguments, count);
      case 9: return advance_of<9>(arguments, count);
      default: throw std::logic_error("a number of components that no rank has");
    }
  }
  Reduction move(const MoveArguments<Real>& arguments, Index count) const override {
    return find_largest<1>(space_, reductions_, count, Move<Real>{arguments}, "moving particles");
  }
  Reduction move(const MoveByPassesArguments<Real>& arguments, Index count) const override {
    return find_largest<1>(space_, reductions_, count, MoveByPasses<Real>{arguments}, "moving particles");
  }
  Reduction largest_square(FieldView<const Real> field, int components, Index count) const override {
    return find_largest<1>(space_, reductions_, count, SquaredLength<Real>{field, components},
                           "the largest value of a field");
  }
  Reduction largest_change(FieldView<const Real> velocity, FieldView<const double> way, double step_size,
                           int components, Index count) const override {
    return find_largest<1>(space_, reductions_, count, SquaredChange<Real>{velocity, way, 2.0 / step_size, components},
                           "the largest change of a velocity");
  }
  Reduction is_outside(FieldView<const Real> field, int components, Index count, double lowest,
                       double highest) const override {
    constexpr const char* what = "the bounds of a field";
    if (components == 1)
      return find_largest<1>(space_, reductions_, count, ValueOutside<Real>{field, Real(lowest), Real(highest)}, what);
    return find_largest<1>(space_, reductions_, count,
                           LengthOutside<Real>{field, components, Real(lowest), Real(highest)}, what);
  }

 private:
  template <int Components>
  Reduction advance_of(const AdvanceArguments<Real>& arguments, Index count) const {
    return find_largest<2>(space_, reductions_, count, AdvanceField<Real, Components>{arguments}, "advancing a field");
  }

  Space space_;
  Reductions& reductions_;
};

}  // namespace mesogen::exec
