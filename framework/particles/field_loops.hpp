#pragma once

#include "exec/backend.hpp"
#include "exec/program.hpp"
#include "mesogen/fields/field_view.hpp"

/// Loops over the values of fields, and over particles that move by them.
namespace mesogen::exec {

/// f = from + by * rate, in double, and what passes see of it.
template <class Real>
struct AdvanceArguments {
  FieldView<const double> from;
  FieldView<const Real> rate;
  double by;
  FieldView<double> exact;
  FieldView<Real> rounded;
  int components;
};

/// f = f + a number for each component, and what passes see of it.
template <class Real>
struct AddArguments {
  FieldView<double> exact;
  FieldView<Real> rounded;
  double by[3];  ///< a scalar's or vector's
  int components;
};

/// r = r + by * u + shift_by * s.
template <class Real>
struct MoveArguments {
  double* position[3];
  const double* sorted[3];  ///< where particles were sorted; null where nobody asks how far they are from there
  FieldView<const double> velocity;
  double by;
  FieldView<const Real> shift;  ///< may be empty
  double shift_by;
  int dimension;
};

/// A step by a velocity that passes make: half of it, kept as `way`, or the whole of it from where it began.
template <class Real>
struct MoveByPassesArguments {
  double* position[3];
  const double* sorted[3];  ///< as in MoveArguments
  FieldView<double> way;
  FieldView<const Real> velocity;
  FieldView<const Real> shift;  ///< may be empty
  double step_size;
  bool to_midpoint;
  int dimension;
};

/// rate += sign * velocity . gradient of the field.
template <class Real>
struct AdvectArguments {
  FieldView<const Real> gradient, velocity;
  FieldView<Real> rate;
  int components;
  int dimension;
  Real sign;
};

/// A coefficient that is `number` where `scale`, which may be empty, is `usual`, and varies in proportion to it.
template <class Real>
struct ScaledCoefficient {
  Real number;
  FieldView<const Real> scale;
  Real usual;

  MESOGEN_HOST_DEVICE Real operator()(Index i) const { return scale ? number * (scale(i) / usual) : number; }
};

/// The linear terms of a field; see schedule/linear_terms.hpp.
template <class Real>
struct LinearCoefficients {
  FieldView<const Real> divisor;  ///< may be empty
  FieldView<const Real> axis;     ///< may be empty: nothing is damped along it
  ScaledCoefficient<Real> diffusion, damping, damping_along_axis;
};

/// rate += (diffusion * laplacian - damping * value - damping along the axis) / divisor.
template <class Real>
struct LinearArguments {
  LinearCoefficients<Real> linear;
  FieldView<const Real> value;
  FieldView<const Real> laplacian;  ///< may be empty
  FieldView<Real> rate;
  int components;
};

/// One stage of a stabilised step; see time/stages.hpp. For the increment Y of a field since the start of the step,
///   before = of_latest * latest + of_before * before + of_slope * slope + linear terms of latest
template <class Real>
struct StageArguments {
  LinearCoefficients<Real> linear;
  FieldView<const Real> latest, slope;
  FieldView<Real> before;
  Real of_latest, of_before, of_slope;
  int components;

  /// For numbers, or for packs of them.
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane next(const Lane& latest_one, const Lane& before_one,
                                                       const Lane& slope_one, const Lane& stiff) const {
    return latest_one * of_latest + before_one * of_before + (slope_one * of_slope + stiff);
  }
};

template <class Real>
class FieldLoops {
 public:
  FieldLoops() = default;
  FieldLoops(const FieldLoops&) = delete;
  FieldLoops& operator=(const FieldLoops&) = delete;
  virtual ~FieldLoops() = default;

  virtual void zero(FieldView<Real> field, int components, Index count) const = 0;
  virtual void advect(const AdvectArguments<Real>& arguments, Index count) const = 0;
  virtual void add_linear(const LinearArguments<Real>& arguments, Index count) const = 0;
  /// `laplacian`: of the latest; may be empty.
  virtual void stage(const StageArguments<Real>& arguments, FieldView<const Real> laplacian, Index count) const = 0;
  /// Evaluates a program at the particles.
  virtual void evaluate(const EvaluateArguments<Real>& arguments, Index count) const = 0;
  /// to = factor * from.
  virtual void scale(FieldView<const Real> from, Real factor, FieldView<Real> to, int components,
                     Index count) const = 0;
  virtual void advance(const AdvanceArguments<Real>& arguments, Index count) const = 0;
  /// The same, and finds the largest squared length of the value, and next of the rate; infinite where something is not
  /// a number.
  virtual Reduction advance_and_look(const AdvanceArguments<Real>& arguments, Index count) const = 0;
  virtual void move(const MoveArguments<Real>& arguments, Index count) const = 0;
  virtual void move(const MoveByPassesArguments<Real>& arguments, Index count) const = 0;
  /// The same, and finds the square of how far a particle is from where it was sorted (0 where that is not given);
  /// infinite if a particle is nowhere.
  virtual Reduction move_and_look(const MoveArguments<Real>& arguments, Index count) const = 0;
  virtual Reduction move_and_look(const MoveByPassesArguments<Real>& arguments, Index count) const = 0;
  /// Adds up numbers in so many parts, each in a fixed order: for a device, where nobody adds up exactly.
  static constexpr Index parts = 16384;
  virtual void partial_sums(const double* values, Index count, double* sums) const = 0;
  /// exact += by, and what passes see of it.
  virtual void add(const AddArguments<Real>& arguments, Index count) const = 0;
  /// Finds the largest squared length of a vector; infinite where something is not a number.
  virtual Reduction largest_square(FieldView<const Real> field, int components, Index count) const = 0;
  /// The same of (u - 2 / dt way): what a step changed.
  virtual Reduction largest_change(FieldView<const Real> velocity, FieldView<const double> way, double step_size,
                                   int components, Index count) const = 0;
  /// Finds a number above 0 if a value (a vector's length) is outside the bounds, or not a number.
  virtual Reduction is_outside(FieldView<const Real> field, int components, Index count, double lowest,
                               double highest) const = 0;
};

}  // namespace mesogen::exec
