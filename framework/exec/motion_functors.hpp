#pragma once

#include <cmath>

#include "exec/backend.hpp"
#include "exec/largest.hpp"

/// What a time step does to each particle.
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
struct Advance {
  Advancing<Real> a;

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
  Moving<Real> m;

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
  MovingByPasses<Real> m;

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

template <class T>
struct Gather {
  const T* from;
  const Index* order;
  T* to;
  MESOGEN_HOST_DEVICE void operator()(Index n) const { to[n] = from[order[n]]; }
};

template <class T>
struct Copy {
  const T* from;
  T* to;
  MESOGEN_HOST_DEVICE void operator()(Index n) const { to[n] = from[n]; }
};

}  // namespace mesogen::exec
