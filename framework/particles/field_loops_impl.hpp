#pragma once

#include <stdexcept>

#include "exec/program_evaluation.hpp"
#include "exec/reductions.hpp"
#include "particles/field_loops.hpp"
#include "particles/linear_loops.hpp"

/// The loops over fields, compiled by g++ for the host, for each instruction set, and by nvcc for CUDA.
namespace mesogen::exec {

/// Calls action<n>(), compiled for each of the numbers that n may be: a loop with a number of components that the
/// compiler knows handles several particles at a time. Throws std::logic_error if n is none of them.
template <int First, int... Others, class Action>
auto compiled_for(int n, const Action& action) {
  if (n == First) return action.template operator()<First>();
  if constexpr (sizeof...(Others) > 0) return compiled_for<Others...>(n, action);
  throw std::logic_error("a number of components or dimensions that no field has");
}
template <class Action>
auto for_components(int n, const Action& action) {
  return compiled_for<1, 2, 3, 4, 5, 9>(n, action);
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
    largest.raise(0, value_square);
    largest.raise(1, rate_square);
  }
};

/// Raises if the particle is nowhere.
template <class Real, int Dim>
struct Move {
  MoveArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& nowhere) const {
    for (int d = 0; d < Dim; ++d) {
      const double at = m.position[d][i] + m.by * m.velocity(d, i) +
                        (m.shift ? m.shift_by * static_cast<double>(m.shift(d, i)) : 0.0);
      m.position[d][i] = at;
      nowhere.raise(0, at - at);  // 0, or not a number
    }
  }
};

template <class Real, int Dim, bool ToMidpoint>
struct MoveByPasses {
  MoveByPassesArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& nowhere) const {
    for (int d = 0; d < Dim; ++d) {
      double by = 0.0;
      if constexpr (ToMidpoint) {
        by = m.step_size / 2.0 * static_cast<double>(m.velocity(d, i));
        m.way(d, i) = by;
      } else {
        const double speed =
            static_cast<double>(m.velocity(d, i)) + (m.shift ? static_cast<double>(m.shift(d, i)) : 0.0);
        by = m.step_size * speed - m.way(d, i);
      }
      const double at = m.position[d][i] + by;
      m.position[d][i] = at;
      nowhere.raise(0, at - at);  // 0, or not a number
    }
  }
};

template <class Real, int Components>
struct SquaredLength {
  FieldView<const Real> field;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& largest) const {
    double square = 0.0;
    for (int c = 0; c < Components; ++c) {
      const auto value = static_cast<double>(field(c, i));
      square += value * value;
    }
    largest.raise(0, square);
  }
};

template <class Real, int Components>
struct SquaredChange {
  FieldView<const Real> velocity;
  FieldView<const double> way;
  double per_half_step;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& largest) const {
    double square = 0.0;
    for (int c = 0; c < Components; ++c) {
      const double change = static_cast<double>(velocity(c, i)) - per_half_step * way(c, i);
      square += change * change;
    }
    largest.raise(0, square);
  }
};

/// Raises if a value is outside the bounds or not a number.
template <class Real>
struct ValueOutside {
  FieldView<const Real> field;
  Real lowest, highest;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& outside) const {
    outside.raise(0, field(i) >= lowest && field(i) <= highest ? 0.0 : 1.0);
  }
};

/// The same of a vector's length.
template <class Real, int Components>
struct LengthOutside {
  FieldView<const Real> field;
  Real lowest, highest;

  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& outside) const {
    const Real least = lowest > Real(0) ? lowest * lowest : Real(0);
    Real square(0);
    for (int c = 0; c < Components; ++c) square += field(c, i) * field(c, i);
    outside.raise(0, square <= highest * highest ? (square >= least ? 0.0 : 1.0) : 1.0);
  }
};

template <class Real, int Components>
struct Zero {
  FieldView<Real> field;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < Components; ++c) field(c, i) = Real(0);
  }
};

/// What particles see that move relative to the fluid.
template <class Real, int Components, int Dim>
struct Advect {
  AdvectArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < Components; ++c) {
      Real change = Real(0);
      for (int d = 0; d < Dim; ++d) change += a.velocity(d, i) * a.gradient(c * Dim + d, i);
      a.rate(c, i) += a.sign * change;
    }
  }
};

template <class Real, int Components>
struct ScaleField {
  FieldView<const Real> from;
  Real factor;
  FieldView<Real> to;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < Components; ++c) to(c, i) = factor * from(c, i);
  }
};

template <class Real>
class FieldLoopsImpl final : public FieldLoops<Real> {
 public:
  FieldLoopsImpl(const Space& space, Reductions& reductions) : space_(space), reductions_(reductions) {}

  void zero(FieldView<Real> field, int components, Index count) const override {
    for_components(components, [&]<int N>() { for_each(space_, count, Zero<Real, N>{field}, "zeroing a field"); });
  }
  void advect(const AdvectArguments<Real>& arguments, Index count) const override {
    compiled_for<2, 3>(arguments.dimension, [&]<int Dim>() {
      for_components(arguments.components,
                     [&]<int N>() { for_each(space_, count, Advect<Real, N, Dim>{arguments}, "advection"); });
    });
  }
  void add_linear(const LinearArguments<Real>& arguments, Index count) const override {
    for_components(arguments.components,
                   [&]<int N>() { for_each(space_, count, AddLinear<Real, N>{arguments}, "linear terms"); });
  }
  void stage(const StageArguments<Real>& arguments, FieldView<const Real> laplacian, Index count) const override {
    for_components(arguments.components, [&]<int N>() {
      for_each(space_, count, StageOfField<Real, N>{arguments, laplacian}, "a stage of a step");
    });
  }
  void evaluate(const EvaluateArguments<Real>& arguments, Index count) const override {
    constexpr const char* what = "prescribed values";
#ifdef __CUDACC__
    for_each(space_, count, EvaluateProgram<Real, 1>{arguments, count}, what);
#else
    constexpr int lanes = 32;
    for_each(space_, (count + lanes - 1) / lanes, EvaluateProgram<Real, lanes>{arguments, count}, what);
#endif
  }
  void scale(FieldView<const Real> from, Real factor, FieldView<Real> to, int components, Index count) const override {
    for_components(components, [&]<int N>() {
      for_each(space_, count, ScaleField<Real, N>{from, factor, to}, "scaling a field");
    });
  }
  Reduction advance(const AdvanceArguments<Real>& arguments, Index count) const override {
    return for_components(arguments.components, [&]<int N>() {
      return find_largest<2>(space_, reductions_, count, AdvanceField<Real, N>{arguments}, "advancing a field");
    });
  }
  Reduction move(const MoveArguments<Real>& arguments, Index count) const override {
    return compiled_for<1, 2, 3>(arguments.dimension, [&]<int Dim>() {
      return find_largest<1>(space_, reductions_, count, Move<Real, Dim>{arguments}, "moving particles");
    });
  }
  Reduction move(const MoveByPassesArguments<Real>& arguments, Index count) const override {
    return compiled_for<2, 3>(arguments.dimension, [&]<int Dim>() {
      if (arguments.to_midpoint)
        return find_largest<1>(space_, reductions_, count, MoveByPasses<Real, Dim, true>{arguments},
                               "moving particles");
      return find_largest<1>(space_, reductions_, count, MoveByPasses<Real, Dim, false>{arguments}, "moving particles");
    });
  }
  Reduction largest_square(FieldView<const Real> field, int components, Index count) const override {
    return for_components(components, [&]<int N>() {
      return find_largest<1>(space_, reductions_, count, SquaredLength<Real, N>{field}, "the largest value of a field");
    });
  }
  Reduction largest_change(FieldView<const Real> velocity, FieldView<const double> way, double step_size,
                           int components, Index count) const override {
    return for_components(components, [&]<int N>() {
      return find_largest<1>(space_, reductions_, count, SquaredChange<Real, N>{velocity, way, 2.0 / step_size},
                             "the largest change of a velocity");
    });
  }
  Reduction is_outside(FieldView<const Real> field, int components, Index count, double lowest,
                       double highest) const override {
    constexpr const char* what = "the bounds of a field";
    if (components == 1)
      return find_largest<1>(space_, reductions_, count, ValueOutside<Real>{field, Real(lowest), Real(highest)}, what);
    return for_components(components, [&]<int N>() {
      return find_largest<1>(space_, reductions_, count, LengthOutside<Real, N>{field, Real(lowest), Real(highest)},
                             what);
    });
  }

 private:
  Space space_;
  Reductions& reductions_;
};

#ifndef __CUDACC__
// In field_loops.cpp, for each instruction set.
extern template class MESOGEN_EXPORT FieldLoopsImpl<float>;
extern template class MESOGEN_EXPORT FieldLoopsImpl<double>;
#endif

}  // namespace mesogen::exec
