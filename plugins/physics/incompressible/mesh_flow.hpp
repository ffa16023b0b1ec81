#pragma once

// What the flow does on the mesh, for a scene: one object a run.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "advection.hpp"
#include "limited_diffusion.hpp"
#include "mesogen/mesh/particle_spectrum.hpp"
#include "mesogen/plugin/context.hpp"
#include "momentum.hpp"
#include "velocity_gradient.hpp"

namespace mesogen::incompressible {

struct Numerics {
  int corrections = 0;  ///< of a fit of modes to particles, see mesh::ParticleSpectrum::fit
  double shift = 0.0;   ///< how fast unevenness is taken away, in mean velocity gradients
};

template <class Real, int Dim>
class MeshFlow {
 public:
  using Spectrum = mesh::ParticleSpectrum<Dim, Real>;
  using Kept = mesh::KeptModes<Dim>;
  using Modes = std::array<Complex*, Dim>;
  using WaveVector = typename Spectrum::WaveVector;

  MeshFlow(const mesh::Grid<Dim>& grid, double particle_spacing, const Fluid& fluid, const Numerics& numerics)
      : spacing_(particle_spacing),
        fluid_(fluid),
        numerics_(numerics),
        spectrum_(grid),
        momentum_(spectrum_.kept(), fluid) {
    for (auto* const modes : {&midpoint_, &work_})
      for (auto& component : *modes) component.resize(spectrum_.mode_count());
  }

  /// How far a shift may take a particle in one step, in spacings.
  static constexpr double farthest_shift = 0.1;

  Momentum<Dim>& momentum() { return momentum_; }
  /// Root mean square of the velocity's gradient at the midpoint of the step, 1/s.
  [[nodiscard]] double mean_gradient() const { return mean_gradient_; }

  /// Where the mesh begins at the start of the step, m: it goes with the mean velocity, as a particle would, so that
  /// particles cross it only as fast as they move through the fluid around them. For checkpoints.
  [[nodiscard]] std::span<double> origin() { return origin_; }

  /// Velocity and its gradient as they will be at the middle of the step, at the particles.
  void to_midpoint(const PassContext& context) {
    if (context.step_size() == 0.0) origin_ = {};
    here_ = origin_;
    for (int d = 0; d < Dim; ++d) here_[d] += 0.5 * context.step_size() * momentum_.velocity(d)[0].real();
    locate(context);
    const Modes midpoint = modes_of(midpoint_);
    if (context.step_size() == 0.0) {
      fit(context.read<Real>("velocity"), midpoint);
      momentum_.start(context.time(), midpoint);
    }
    momentum_.velocity_at(context.time(), midpoint);
    mean_gradient_ = incompressible::mean_gradient<Dim>(spectrum_.kept(), midpoint_, row_sums_);
    const auto velocity = context.write<Real>("velocity");
    const auto gradient = context.write<Real>("velocity_gradient");
    const auto density = context.write<Real>("density");
    const auto rho = Real(fluid_.density);
    spectrum_.template evaluate<Dim + gradients>(
        [&](std::size_t n, const WaveVector& k, Complex* modes) {
          for (int d = 0; d < Dim; ++d) modes[d] = midpoint[d][n];
          differentiate<Dim>(k, modes, modes + Dim);
        },
        [&](Index i, const Real* there) {
          for (int d = 0; d < Dim; ++d) velocity(d, i) = there[d];
          put_gradient<Dim>(gradient, i, there + Dim);
          density(i) = rho;
        });
  }

  /// The forces of the others, at the midpoint, into the momentum equation.
  void add_forces(const PassContext& context) {
    locate(context);
    const Modes force = modes_of(work_);
    find_acceleration(context, force);
    momentum_.take(context.time(), force);
  }

  /// p at the particles: what takes the divergence out of the forces.
  void pressure(const PassContext& context) {
    locate(context);
    const Modes force = modes_of(work_);
    find_acceleration(context, force);
    const auto pressure = context.write<Real>("pressure");
    spectrum_.template evaluate<1>(
        [&](std::size_t n, const WaveVector& k, Complex* mode) {
          const double square = Kept::square(k);
          Complex divergence(0.0);
          for (int d = 0; d < Dim; ++d) divergence += mesh::derivative(k[d], force[d][n]);
          *mode = square > 0.0 ? -fluid_.density / square * divergence : Complex(0.0);
        },
        [&](Index i, const Real* there) { pressure(i) = *there; });
  }

  /// The flow at the end of the step, where the particles have gone.
  void to_end(const PassContext& context) {
    for (int d = 0; d < Dim; ++d) {
      const double length = spectrum_.grid().length[d];
      origin_[d] += context.step_size() * midpoint_[d][0].real();
      origin_[d] -= length * std::floor(origin_[d] / length);
    }
    here_ = origin_;
    locate(context);
    momentum_.advance_to(context.time());
    const auto velocity = context.write<Real>("velocity");
    spectrum_.template evaluate<Dim>(
        [&](std::size_t n, const WaveVector&, Complex* modes) {
          for (int d = 0; d < Dim; ++d) modes[d] = momentum_.velocity(d)[n];
        },
        [&](Index i, const Real* there) {
          for (int d = 0; d < Dim; ++d) velocity(d, i) = there[d];
        });
  }

  /// The gradient of the velocity that the particles have, for readers.
  void velocity_gradient(const PassContext& context) {
    here_ = {};
    locate(context);
    const Modes velocity = modes_of(work_);
    fit(context.read<Real>("velocity"), velocity);
    const auto gradient = context.write<Real>("velocity_gradient");
    spectrum_.template evaluate<gradients>(
        [&](std::size_t n, const WaveVector& k, Complex* modes) {
          std::array<Complex, Dim> u{};
          for (int d = 0; d < Dim; ++d) u[d] = velocity[d][n];
          Momentum<Dim>::project(k, u);
          differentiate<Dim>(k, u.data(), modes);
        },
        [&](Index i, const Real* there) { put_gradient<Dim>(gradient, i, there); });
  }

  /// Gradient and Laplacian of the order tensor. Of what the mesh does not carry the Laplacian is that of its shortest
  /// wave: nothing else would damp it. `diffusivity` x `step_size` are what the Laplacian will be multiplied by;
  /// 0 for readers, who see the same in a replay, where nobody knows how far the mesh has gone. `Spreads`: particles
  /// are spread as by spread_particles(): with what is interpolated to them here that costs little.
  template <bool Spreads>
  void order_tensor_derivatives(const PassContext& context, double diffusivity, double step_size) {
    if (step_size == 0.0 && !Spreads) here_ = {};
    locate(context);
    constexpr int components = 2;
    const auto q = context.read<Real>("order_tensor");
    const Modes tensor = modes_of(work_);
    spectrum_.template fit<components>(
        [&](Index i, Real* numbers) {
          for (int c = 0; c < components; ++c) numbers[c] = q(c, i);
        },
        tensor, numerics_.corrections);
    const double scale = diffusivity * step_size;
    const double shortest = std::pow(smallest_cutoff(spectrum_.kept()), 2);
    const double below = shortest * limited(scale * shortest);
    constexpr int slopes = components * Dim;
    const auto gradient = context.write<Real>("order_tensor_gradient");
    const auto laplacian = context.write<Real>("order_tensor_laplacian");
    constexpr int numbers = slopes + components;
    Spreading spreading;
    if constexpr (Spreads) spreading = find_spreading(context);
    spectrum_.template evaluate<numbers + (Spreads ? Dim : 0)>(
        [&](std::size_t n, const WaveVector& k, Complex* modes) {
          const double square = Kept::square(k);
          for (int c = 0; c < components; ++c) {
            for (int d = 0; d < Dim; ++d) modes[c * Dim + d] = mesh::derivative(k[d], tensor[c][n]);
            modes[slopes + c] = (below - square * limited(scale * square)) * tensor[c][n];
          }
          if constexpr (Spreads) spreading.modes(n, k, modes + numbers);
        },
        [&](Index i, const Real* there) {
          for (int c = 0; c < slopes; ++c) gradient(c, i) = there[c];
          for (int c = 0; c < components; ++c) laplacian(c, i) = there[slopes + c] - Real(below) * q(c, i);
          if constexpr (Spreads) spreading.add(i, there + numbers);
        });
  }

  /// Moves particles from where they are dense to where they are sparse: a velocity v with div v = s delta takes
  /// unevenness delta away at the rate s.
  void spread_particles(const PassContext& context) {
    locate(context);
    const Spreading spreading = find_spreading(context);
    spectrum_.template evaluate<Dim>(
        [&](std::size_t n, const WaveVector& k, Complex* modes) { spreading.modes(n, k, modes); },
        [&](Index i, const Real* there) { spreading.add(i, there); });
  }

 private:
  struct Spreading {
    double rate = 0.0;  // 1/s
    Real fastest{};     // m/s
    const Complex* uneven = nullptr;
    FieldView<Real> shift;

    void modes(std::size_t n, const WaveVector& k, Complex* velocity) const {
      const double square = Kept::square(k);
      for (int d = 0; d < Dim; ++d)
        velocity[d] = square > 0.0 ? mesh::derivative(-rate * k[d] / square, uneven[n]) : Complex(0.0);
    }
    void add(Index i, const Real* velocity) const {
      Real square = Real(0);
      for (int d = 0; d < Dim; ++d) square += velocity[d] * velocity[d];
      const Real speed = std::sqrt(square);
      const Real part = speed > fastest ? fastest / speed : Real(1);
      for (int d = 0; d < Dim; ++d) shift(d, i) += part * velocity[d];
    }
  };

  Spreading find_spreading(const PassContext& context) {
    uneven_.resize(spectrum_.mode_count());
    spectrum_.unevenness(uneven_.data());
    const double step = context.step_size();
    double rate = numerics_.shift * mean_gradient_;
    if (step > 0.0) rate = std::min(rate, 0.5 / step);
    const double fastest = step > 0.0 ? farthest_shift * spacing_ / step : 0.0;
    return {rate, static_cast<Real>(fastest), uneven_.data(), context.write<Real>("shift_velocity")};
  }

  static constexpr int gradients = gradient_elements<Dim>;

  void locate(const PassContext& context) {
    if (located_ == context.positions_version() && located_from_ == here_) return;
    std::array<const double*, Dim> position{};
    for (int d = 0; d < Dim; ++d) position[d] = context.position(d);
    spectrum_.locate(position, context.count(), here_);
    located_ = context.positions_version();
    located_from_ = here_;
  }

  void fit(const FieldView<const Real>& vector, const Modes& modes) {
    spectrum_.template fit<Dim>(
        [&](Index i, Real* numbers) {
          for (int d = 0; d < Dim; ++d) numbers[d] = vector(d, i);
        },
        modes, numerics_.corrections);
  }

  // f / rho - div(u u), u relative to the mesh, and what friction is to be added back, because the momentum equation
  // takes it implicitly.
  void find_acceleration(const PassContext& context, const Modes& force) {
    fit(context.read<Real>("acceleration"), force);
    if (fluid_.friction > 0.0) {
      const double add = fluid_.friction / fluid_.density;
      spectrum_.kept().for_each([&](std::size_t n, const WaveVector&) {
        for (int d = 0; d < Dim; ++d) force[d][n] += add * midpoint_[d][n];
      });
    }
    if (!fluid_.inertia) return;
    // The mesh goes with the mean.
    const auto relative = [&](std::size_t n, Complex* numbers) {
      for (int d = 0; d < Dim; ++d) numbers[d] = n == 0 ? Complex(0.0) : midpoint_[d][n];
    };
    subtract_advection<Dim>(spectrum_.transform(), relative, force);
  }

  Modes modes_of(std::array<std::vector<Complex>, Dim>& all) {
    Modes modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = all[d].data();
    return modes;
  }

  double spacing_;
  Fluid fluid_;
  Numerics numerics_;
  Spectrum spectrum_;
  Momentum<Dim> momentum_;
  std::array<double, Dim> origin_{};  // of the mesh at the start of the step, m
  std::array<double, Dim> here_{};    // where it is now
  std::uint64_t located_ = 0;
  std::array<double, Dim> located_from_{};
  std::array<std::vector<Complex>, Dim> midpoint_;  // the velocity
  std::array<std::vector<Complex>, Dim> work_;
  std::vector<Complex> uneven_;
  std::vector<double> row_sums_;
  double mean_gradient_ = 0.0;  // 1/s
};

}  // namespace mesogen::incompressible
