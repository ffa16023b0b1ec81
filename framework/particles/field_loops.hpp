#pragma once

#include "exec/backend.hpp"
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

/// r = r + by * u + shift_by * s.
template <class Real>
struct MoveArguments {
  double* position[3];
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

template <class Real>
class FieldLoops {
 public:
  FieldLoops() = default;
  FieldLoops(const FieldLoops&) = delete;
  FieldLoops& operator=(const FieldLoops&) = delete;
  virtual ~FieldLoops() = default;

  virtual void zero(FieldView<Real> field, int components, Index count) const = 0;
  virtual void advect(const AdvectArguments<Real>& arguments, Index count) const = 0;
  /// Finds the largest squared length of the value, and next of the rate; infinite where something is not a number.
  virtual Reduction advance(const AdvanceArguments<Real>& arguments, Index count) const = 0;
  /// Finds a number above 0 if a particle is nowhere.
  virtual Reduction move(const MoveArguments<Real>& arguments, Index count) const = 0;
  virtual Reduction move(const MoveByPassesArguments<Real>& arguments, Index count) const = 0;
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
