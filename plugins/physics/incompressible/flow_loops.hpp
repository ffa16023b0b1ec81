#pragma once

// What the flow does at each mode and at each particle: loops on the host and on a device call these.

#include <array>
#include <cmath>
#include <cstddef>

#include "limited_diffusion.hpp"
#include "mesogen/exec/lanes.hpp"
#include "mesogen/fields/field_view.hpp"
#include "momentum_modes.hpp"
#include "velocity_gradient.hpp"

namespace mesogen::incompressible {

/// The first `Count` components of a field at a particle.
template <class Real, int Count>
struct Components {
  FieldView<const Real> field;

  MESOGEN_HOST_DEVICE void operator()(Index i, Real* numbers) const {
    for (int c = 0; c < Count; ++c) numbers[c] = field(c, i);
  }
};

template <class Real, int Dim>
struct PutVelocity {
  FieldView<Real> velocity;

  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* there) const {
    for (int d = 0; d < Dim; ++d) velocity(d, i) = there[d];
  }
};

template <class Real, int Dim>
struct PutGradient {
  FieldView<Real> gradient;

  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* there) const { put_gradient<Dim>(gradient, i, there); }
};

template <class Real, int Dim>
struct PutFlow {
  FieldView<Real> velocity;
  FieldView<Real> gradient;
  FieldView<Real> density;
  Real rho;

  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* there) const {
    for (int d = 0; d < Dim; ++d) velocity(d, i) = there[d];
    put_gradient<Dim>(gradient, i, there + Dim);
    density(i) = rho;
  }
};

template <class Real>
struct PutScalar {
  FieldView<Real> field;

  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* there) const { field(i) = *there; }
};

template <int Dim>
struct VelocityOf {
  std::array<const Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>&, Complex* modes) const {
    for (int d = 0; d < Dim; ++d) modes[d] = velocity[d][n];
  }
};

/// Relative to the mesh, which goes with the mean.
template <int Dim>
struct VelocityWithoutMean {
  std::array<const Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>&, Complex* modes) const {
    for (int d = 0; d < Dim; ++d) modes[d] = n == 0 ? Complex(0.0) : velocity[d][n];
  }
};

/// The velocity, and the elements of its gradient.
template <int Dim>
struct VelocityAndGradient {
  std::array<const Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* modes) const {
    for (int d = 0; d < Dim; ++d) modes[d] = velocity[d][n];
    differentiate<Dim>(k, modes, modes + Dim);
  }
};

/// The gradient of what has no divergence of a velocity.
template <int Dim>
struct ProjectedGradient {
  std::array<const Complex*, Dim> velocity;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* modes) const {
    Complex u[Dim];
    for (int d = 0; d < Dim; ++d) u[d] = velocity[d][n];
    project<Dim>(k, u);
    differentiate<Dim>(k, u, modes);
  }
};

/// p of an acceleration: its gradient takes the divergence out.
template <int Dim>
struct PressureOf {
  std::array<const Complex*, Dim> acceleration;
  double density;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* mode) const {
    const double square = mesh::KeptModes<Dim>::square(k);
    Complex divergence(0.0);
    for (int d = 0; d < Dim; ++d) divergence += mesh::derivative(k[d], acceleration[d][n]);
    *mode = square > 0.0 ? -density / square * divergence : Complex(0.0);
  }
};

/// to += factor from
template <int Dim>
struct AddModes {
  std::array<const Complex*, Dim> from;
  std::array<Complex*, Dim> to;
  double factor;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>&) const {
    for (int d = 0; d < Dim; ++d) to[d][n] += factor * from[d][n];
  }
};

/// The mean of a velocity is its mode of k = 0: for a loop over one.
template <int Dim>
struct CopyMean {
  std::array<const Complex*, Dim> velocity;
  double* mean;

  MESOGEN_HOST_DEVICE void operator()(Index) const {
    for (int d = 0; d < Dim; ++d) mean[d] = velocity[d][0].re;
  }
};

/// The velocity that moves particles from where they are dense to where they are sparse: a velocity v with
/// div v = s delta takes unevenness delta away at the rate s.
template <class Real, int Dim>
struct Spreading {
  double rate = 0.0;  // 1/s
  Real fastest{};     // m/s
  const Complex* uneven = nullptr;
  FieldView<Real> shift;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* velocity) const {
    const double square = mesh::KeptModes<Dim>::square(k);
    for (int d = 0; d < Dim; ++d)
      velocity[d] = square > 0.0 ? mesh::derivative(-rate * k[d] / square, uneven[n]) : Complex(0.0);
  }
  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* velocity) const {
    Real square = Real(0);
    for (int d = 0; d < Dim; ++d) square += velocity[d] * velocity[d];
    const Real speed = exec::square_root(square);
    const Real part = speed > fastest ? fastest / speed : Real(1);
    for (int d = 0; d < Dim; ++d) shift(d, i) += part * velocity[d];
  }
};

/// Gradient and Laplacian of a tensor with `Components` components. Of what the mesh does not carry the Laplacian is
/// that of its shortest wave. `Spreads`: with the velocity of Spreading behind them.
template <class Real, int Dim, int Components, bool Spreads>
struct TensorDerivatives {
  static constexpr int slopes = Components * Dim;
  static constexpr int numbers = slopes + Components;
  static constexpr int all = numbers + (Spreads ? Dim : 0);

  std::array<const Complex*, Components> tensor;
  double scale;  // diffusivity times step, m2
  double below;  // minus the Laplacian of the shortest wave over the wave, 1/m2
  FieldView<const Real> q;
  FieldView<Real> gradient;
  FieldView<Real> laplacian;
  Spreading<Real, Dim> spreading;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* modes) const {
    const double square = mesh::KeptModes<Dim>::square(k);
    for (int c = 0; c < Components; ++c) {
      for (int d = 0; d < Dim; ++d) modes[c * Dim + d] = mesh::derivative(k[d], tensor[c][n]);
      modes[slopes + c] = (below - square * limited(scale * square)) * tensor[c][n];
    }
    if constexpr (Spreads) spreading(n, k, modes + numbers);
  }
  MESOGEN_HOST_DEVICE void operator()(Index i, const Real* there) const {
    for (int c = 0; c < slopes; ++c) gradient(c, i) = there[c];
    for (int c = 0; c < Components; ++c) laplacian(c, i) = there[slopes + c] - Real(below) * q(c, i);
    if constexpr (Spreads) spreading(i, there + numbers);
  }
};

}  // namespace mesogen::incompressible
