#pragma once

#include <cmath>
#include <complex>

#include "mesogen/export.hpp"

namespace mesogen::mesh {

/// A complex number for code that runs on a device too: of std::complex, nvcc leaves out there what the host's compiler
/// has built in, without a word. In memory it is like std::complex and the numbers of FFTW and cuFFT.
template <class Real>
struct alignas(2 * sizeof(Real)) ComplexNumber {
  Real re{};
  Real im{};

  ComplexNumber() = default;
  MESOGEN_HOST_DEVICE constexpr ComplexNumber(Real real, Real imaginary = Real(0))  // NOLINT: a real number is one too
      : re(real), im(imaginary) {}
  ComplexNumber(const std::complex<Real>& z) : re(z.real()), im(z.imag()) {}  // NOLINT: nothing is lost
  template <class Other>
  MESOGEN_HOST_DEVICE explicit constexpr ComplexNumber(const ComplexNumber<Other>& z)
      : re(static_cast<Real>(z.re)), im(static_cast<Real>(z.im)) {}

  MESOGEN_HOST_DEVICE constexpr Real real() const { return re; }
  MESOGEN_HOST_DEVICE constexpr Real imag() const { return im; }

  MESOGEN_HOST_DEVICE constexpr ComplexNumber& operator+=(const ComplexNumber& z) { return *this = *this + z; }
  MESOGEN_HOST_DEVICE constexpr ComplexNumber& operator-=(const ComplexNumber& z) { return *this = *this - z; }
  MESOGEN_HOST_DEVICE constexpr ComplexNumber& operator*=(Real by) { return *this = by * *this; }

  MESOGEN_HOST_DEVICE friend constexpr ComplexNumber operator+(const ComplexNumber& a, const ComplexNumber& b) {
    return {a.re + b.re, a.im + b.im};
  }
  MESOGEN_HOST_DEVICE friend constexpr ComplexNumber operator-(const ComplexNumber& a, const ComplexNumber& b) {
    return {a.re - b.re, a.im - b.im};
  }
  MESOGEN_HOST_DEVICE friend constexpr ComplexNumber operator*(Real by, const ComplexNumber& z) {
    return {by * z.re, by * z.im};
  }
  /// |z|^2.
  MESOGEN_HOST_DEVICE friend constexpr Real norm(const ComplexNumber& z) { return z.re * z.re + z.im * z.im; }
  friend Real abs(const ComplexNumber& z) { return std::hypot(z.re, z.im); }
};

/// A mode. Modes are in double precision.
using Complex = ComplexNumber<double>;

/// i k z: the mode of the derivative along an axis of which k is the wave number.
MESOGEN_HOST_DEVICE inline Complex derivative(double k, const Complex& z) { return {-k * z.im, k * z.re}; }

}  // namespace mesogen::mesh
