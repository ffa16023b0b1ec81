#pragma once

#include "exec/program_evaluation.hpp"
#include "exec/reductions.hpp"
#include "particles/components.hpp"
#include "particles/field_loops.hpp"
#include "particles/linear_loops.hpp"
#include "particles/motion_loops.hpp"

/// The loops over fields, compiled by g++ for the host, for each instruction set, and by nvcc for CUDA.
namespace mesogen::exec {

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
    evaluate_program(space_, arguments, count);
  }
  void scale(FieldView<const Real> from, Real factor, FieldView<Real> to, int components, Index count) const override {
    for_components(components, [&]<int N>() {
      for_each(space_, count, ScaleField<Real, N>{from, factor, to}, "scaling a field");
    });
  }
  void advance(const AdvanceArguments<Real>& arguments, Index count) const override {
    for_components(arguments.components,
                   [&]<int N>() { for_each(space_, count, AdvanceField<Real, N>{arguments}, "advancing a field"); });
  }
  Reduction advance_and_look(const AdvanceArguments<Real>& arguments, Index count) const override {
    return for_components(arguments.components, [&]<int N>() {
      return find_largest<2>(space_, reductions_, count, AdvanceField<Real, N>{arguments}, "advancing a field");
    });
  }
  void move(const MoveArguments<Real>& arguments, Index count) const override {
    with_move(arguments, [&](const auto& move) { for_each(space_, count, move, moving); });
  }
  void move(const MoveByPassesArguments<Real>& arguments, Index count) const override {
    with_move(arguments, [&](const auto& move) { for_each(space_, count, move, moving); });
  }
  Reduction move_and_look(const MoveArguments<Real>& arguments, Index count) const override {
    return with_move(arguments,
                     [&](const auto& move) { return find_largest<1>(space_, reductions_, count, move, moving); });
  }
  Reduction move_and_look(const MoveByPassesArguments<Real>& arguments, Index count) const override {
    return with_move(arguments,
                     [&](const auto& move) { return find_largest<1>(space_, reductions_, count, move, moving); });
  }
  void partial_sums(const double* values, Index count, double* sums) const override {
    for_each(space_, this->parts, PartialSum{values, count, this->parts, sums}, "adding up a field");
  }
  void add(const AddArguments<Real>& arguments, Index count) const override {
    compiled_for<1, 2, 3>(arguments.components,
                          [&]<int N>() { for_each(space_, count, Add<Real, N>{arguments}, "adding to a field"); });
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
  static constexpr const char* moving = "moving particles";

  Space space_;
  Reductions& reductions_;
};

#ifndef __CUDACC__
// In field_loops.cpp, for each instruction set.
extern template class MESOGEN_EXPORT FieldLoopsImpl<float>;
extern template class MESOGEN_EXPORT FieldLoopsImpl<double>;
#endif

}  // namespace mesogen::exec
