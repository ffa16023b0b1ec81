#pragma once

#include <cmath>

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen::sph {

namespace detail {

template <int Exponent, class Lane>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline Lane power(const Lane& x) {
  if constexpr (Exponent == 0) {
    return Lane(1);
  } else if constexpr (Exponent == 1) {
    return x;
  } else {
    const Lane half = power<Exponent / 2>(x);
    if constexpr (Exponent % 2 == 0) {
      return half * half;
    } else {
      return half * half * x;
    }
  }
}

/// Writes the coefficients of one piece of W and of dW/dr.
template <class Real>
void scale_piece(const SmoothingKernel& kernel, int k, Real& knot, Real* value, Real* slope) {
  const auto& piece = kernel.shape.pieces[static_cast<unsigned>(k)];
  knot = Real(piece.knot);
  int exponent = kernel.shape.power;
  for (const double coefficient : piece.coefficients) {
    const double c = coefficient * kernel.scale;
    *value++ = Real(c);
    *slope++ = Real(-c * exponent++ / kernel.smoothing_length);
  }
}

}  // namespace detail

/// A normalised kernel of one form, with unrolled loops: `Knots` pieces of `Terms` powers from `Power` up. Coefficients
/// are data, so kernels of the same form share their code. Trivially copyable.
template <class Real, int Knots, int Terms, int Power>
class KernelFunction {
 public:
  explicit KernelFunction(const SmoothingKernel& kernel) : inverse_length_(Real(1.0 / kernel.smoothing_length)) {
    for (int k = 0; k < Knots; ++k) detail::scale_piece(kernel, k, knot_[k], value_[k], slope_[k]);
  }

  /// W(r), 1/m^Dim.
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value(const Lane& r) const {
    return sum<Power>(r * inverse_length_, value_);
  }
  /// dW/dr, 1/m^(Dim + 1).
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane derivative(const Lane& r) const {
    return sum<Power - 1>(r * inverse_length_, slope_);
  }

 private:
  template <int Lowest, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane sum(const Lane& q, const Real (&coefficient)[Knots][Terms]) const {
    Lane total(Real(0));
    for (int k = 0; k < Knots; ++k) {
      const Lane t = exec::positive_part(Lane(knot_[k]) - q);
      Lane polynomial(coefficient[k][Terms - 1]);
      for (int n = Terms - 2; n >= 0; --n) polynomial = polynomial * t + coefficient[k][n];
      total = detail::power<Lowest>(t) * polynomial + total;
    }
    return total;
  }

  Real inverse_length_;
  Real knot_[Knots];
  Real value_[Knots][Terms];
  Real slope_[Knots][Terms];
};

/// A normalised spline: `Knots` pieces of one power, with alternating signs, the first positive. A coefficient is part
/// of its knot, c (k - q)^p = (c^(1/p) k - c^(1/p) q)^p, which saves a quarter of the instructions. Trivially copyable.
template <class Real, int Knots, int Power>
class SplineFunction {
 public:
  explicit SplineFunction(const SmoothingKernel& kernel) {
    for (int k = 0; k < Knots; ++k) {
      const auto& piece = kernel.shape.pieces[static_cast<unsigned>(k)];
      const double c = std::abs(piece.coefficients.front()) * kernel.scale;
      const auto set = [&](Line& line, double coefficient, int power) {
        const double root = std::pow(coefficient, 1.0 / power);
        line = {Real(root * piece.knot), Real(-root / kernel.smoothing_length)};
      };
      set(value_[k], c, Power);
      set(slope_[k], c * Power / kernel.smoothing_length, Power - 1);
    }
  }

  /// True if the shape is such a spline.
  static bool fits(const KernelShape& shape) {
    if (shape.power != Power || shape.pieces.size() != Knots) return false;
    double sign = 1.0;
    for (const auto& piece : shape.pieces) {
      if (piece.coefficients.size() != 1 || !(sign * piece.coefficients.front() > 0.0)) return false;
      sign = -sign;
    }
    return true;
  }

  /// W(r), 1/m^Dim.
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value(const Lane& r) const {
    return sum<Power, false>(r, value_);
  }
  /// dW/dr, 1/m^(Dim + 1).
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane derivative(const Lane& r) const {
    return sum<Power - 1, true>(r, slope_);
  }

 private:
  struct Line {
    Real constant;
    Real slope;
  };

  template <int Exponent, bool Negative, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane sum(const Lane& r, const Line (&line)[Knots]) const {
    Lane total(Real(0));
    exec::unroll<Knots>([&](auto k) __attribute__((always_inline)) {
      const Lane t = exec::positive_part(r * line[k].slope + line[k].constant);
      const Lane lower = detail::power<Exponent / 2>(t);
      Lane upper = lower;
      if constexpr (Exponent % 2 == 1) upper = lower * t;
      total = (k % 2 == 1) == Negative ? total + lower * upper : total - lower * upper;
    });
    return total;
  }

  Line value_[Knots];
  Line slope_[Knots];
};

/// A kernel of any form with up to 6 knots and 6 terms; its loops are not unrolled. Slower, but no shape is refused.
template <class Real>
class GeneralKernelFunction {
 public:
  static constexpr int most = 6;

  explicit GeneralKernelFunction(const SmoothingKernel& kernel)
      : knots_(static_cast<int>(kernel.shape.pieces.size())),
        terms_(static_cast<int>(kernel.shape.pieces.front().coefficients.size())),
        power_(kernel.shape.power),
        inverse_length_(Real(1.0 / kernel.smoothing_length)) {
    for (int k = 0; k < knots_; ++k) detail::scale_piece(kernel, k, knot_[k], value_[k], slope_[k]);
  }

  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value(const Lane& r) const {
    return sum(power_, r * inverse_length_, value_);
  }
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane derivative(const Lane& r) const {
    return sum(power_ - 1, r * inverse_length_, slope_);
  }

 private:
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane sum(int lowest, const Lane& q,
                                                      const Real (&coefficient)[most][most]) const {
    Lane total(Real(0));
    for (int k = 0; k < knots_; ++k) {
      const Lane t = exec::positive_part(Lane(knot_[k]) - q);
      Lane polynomial(coefficient[k][terms_ - 1]);
      for (int n = terms_ - 2; n >= 0; --n) polynomial = polynomial * t + coefficient[k][n];
      for (int n = 0; n < lowest; ++n) polynomial = polynomial * t;
      total = total + polynomial;
    }
    return total;
  }

  int knots_;
  int terms_;
  int power_;
  Real inverse_length_;
  Real knot_[most];
  Real value_[most][most];
  Real slope_[most][most];
};

/// Calls `action` with the unrolled form that fits the kernel. This is the only choice that a pass makes at run time.
template <class Real, class Action>
void with_kernel_function(const SmoothingKernel& kernel, Action&& action) {
  const auto is = [&](unsigned knots, unsigned terms, int power) {
    const auto& shape = kernel.shape;
    return shape.pieces.size() == knots && shape.pieces.front().coefficients.size() == terms && shape.power == power;
  };
  if (SplineFunction<Real, 3, 5>::fits(kernel.shape)) {
    action(SplineFunction<Real, 3, 5>(kernel));  // quintic spline
  } else if (is(1, 2, 4)) {
    action(KernelFunction<Real, 1, 2, 4>(kernel));  // Wendland C2
  } else if (is(1, 3, 6)) {
    action(KernelFunction<Real, 1, 3, 6>(kernel));  // Wendland C4
  } else if (is(1, 4, 8)) {
    action(KernelFunction<Real, 1, 4, 8>(kernel));  // Wendland C6
  } else {
    action(GeneralKernelFunction<Real>(kernel));
  }
}

}  // namespace mesogen::sph
