#pragma once

// What the flow does on the mesh, for a scene: one object a run.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "limited_diffusion.hpp"
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
  using Spectrum = mesh::ParticleSpectrum<Dim>;
  using Modes = std::array<Complex*, Dim>;
  using WaveVector = typename Spectrum::WaveVector;

  MeshFlow(const mesh::Grid<Dim>& grid, double particle_spacing, const Fluid& fluid, const Numerics& numerics)
      : spacing_(particle_spacing), fluid_(fluid), numerics_(numerics), spectrum_(grid), momentum_(spectrum_, fluid) {
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
    mean_gradient_ = incompressible::mean_gradient<Dim>(spectrum_.grid(), midpoint_, row_sums_);
    const auto velocity = context.write<Real>("velocity");
    const auto gradient = context.write<Real>("velocity_gradient");
    const auto density = context.write<Real>("density");
    const auto rho = Real(fluid_.density);
    std::array<Complex*, Dim + gradients> modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = copy(d, midpoint[d]);
    differentiate(midpoint, modes.data() + Dim, Dim);
    spectrum_.template evaluate<Dim + gradients>(modes, [&](Index i, const double* there) {
      for (int d = 0; d < Dim; ++d) velocity(d, i) = Real(there[d]);
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
    Complex* const modes = copy(0, force[0]);
    spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
      const double square = Spectrum::square(k);
      Complex along(0.0);
      for (int d = 0; d < Dim; ++d) along += k[d] * force[d][n];
      modes[n] = square > 0.0 ? Complex(0.0, -fluid_.density / square) * along : Complex(0.0);
    });
    const auto pressure = context.write<Real>("pressure");
    spectrum_.template evaluate<1>({modes}, [&](Index i, const double* there) { pressure(i) = Real(*there); });
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
    Modes modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = copy(d, momentum_.velocity(d));
    spectrum_.template evaluate<Dim>(modes, [&](Index i, const double* there) {
      for (int d = 0; d < Dim; ++d) velocity(d, i) = Real(there[d]);
    });
  }

  /// The gradient of the velocity that the particles have, for readers.
  void velocity_gradient(const PassContext& context) {
    here_ = {};
    locate(context);
    const Modes velocity = modes_of(work_);
    fit(context.read<Real>("velocity"), velocity);
    spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
      std::array<Complex, Dim> u{};
      for (int d = 0; d < Dim; ++d) u[d] = velocity[d][n];
      Momentum<Dim>::project(k, u);
      for (int d = 0; d < Dim; ++d) velocity[d][n] = u[d];
    });
    const auto gradient = context.write<Real>("velocity_gradient");
    std::array<Complex*, gradients> modes{};
    differentiate(velocity, modes.data(), 0);
    spectrum_.template evaluate<gradients>(
        modes, [&](Index i, const double* there) { put_gradient<Dim>(gradient, i, there); });
  }

  /// Gradient and Laplacian of the order tensor. Of what the mesh does not carry the Laplacian is that of its shortest
  /// wave: nothing else would damp it. `diffusivity` x `step_size` are what the Laplacian will be multiplied by;
  /// 0 for readers, who see the same in a replay, where nobody knows how far the mesh has gone.
  void order_tensor_derivatives(const PassContext& context, double diffusivity, double step_size) {
    if (step_size == 0.0) here_ = {};
    locate(context);
    constexpr int components = 2;
    const auto q = context.read<Real>("order_tensor");
    std::array<Complex*, components> tensor{work_[0].data(), work_[1].data()};
    spectrum_.template fit<components>(
        [&](Index i, double* numbers) {
          for (int c = 0; c < components; ++c) numbers[c] = static_cast<double>(q(c, i));
        },
        tensor, numerics_.corrections);
    const double scale = diffusivity * step_size;
    const double shortest = std::pow(smallest_cutoff(spectrum_), 2);
    const double below = shortest * limited(scale * shortest);
    constexpr int slopes = components * Dim;
    std::array<Complex*, slopes + components> modes{};
    for (int c = 0; c < slopes + components; ++c) modes[c] = room(c);
    spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
      const double square = Spectrum::square(k);
      for (int c = 0; c < components; ++c) {
        for (int d = 0; d < Dim; ++d) modes[c * Dim + d][n] = Complex(0.0, k[d]) * tensor[c][n];
        modes[slopes + c][n] = (below - square * limited(scale * square)) * tensor[c][n];
      }
    });
    const auto gradient = context.write<Real>("order_tensor_gradient");
    const auto laplacian = context.write<Real>("order_tensor_laplacian");
    spectrum_.template evaluate<slopes + components>(modes, [&](Index i, const double* there) {
      for (int c = 0; c < slopes; ++c) gradient(c, i) = Real(there[c]);
      for (int c = 0; c < components; ++c)
        laplacian(c, i) = Real(there[slopes + c] - below * static_cast<double>(q(c, i)));
    });
  }

  /// Moves particles from where they are dense to where they are sparse: a velocity v with div v = s delta takes
  /// unevenness delta away at the rate s.
  void spread_particles(const PassContext& context) {
    locate(context);
    Complex* const uneven = work_[0].data();
    spectrum_.unevenness(uneven);
    const double step = context.step_size();
    double rate = numerics_.shift * mean_gradient_;
    if (step > 0.0) rate = std::min(rate, 0.5 / step);
    const double fastest = step > 0.0 ? farthest_shift * spacing_ / step : 0.0;
    Modes modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = room(d);
    spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
      const double square = Spectrum::square(k);
      for (int d = 0; d < Dim; ++d)
        modes[d][n] = square > 0.0 ? Complex(0.0, -rate * k[d] / square) * uneven[n] : Complex(0.0);
    });
    const auto shift = context.write<Real>("shift_velocity");
    spectrum_.template evaluate<Dim>(modes, [&](Index i, const double* there) {
      double square = 0.0;
      for (int d = 0; d < Dim; ++d) square += there[d] * there[d];
      const double most = std::sqrt(square);
      const double part = most > fastest ? fastest / most : 1.0;
      for (int d = 0; d < Dim; ++d) shift(d, i) += Real(part * there[d]);
    });
  }

 private:
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
        [&](Index i, double* numbers) {
          for (int d = 0; d < Dim; ++d) numbers[d] = static_cast<double>(vector(d, i));
        },
        modes, numerics_.corrections);
  }

  // f / rho - div(u u), u relative to the mesh, and what friction is to be added back, because the momentum equation
  // takes it implicitly.
  void find_acceleration(const PassContext& context, const Modes& force) {
    fit(context.read<Real>("acceleration"), force);
    if (fluid_.friction > 0.0) {
      const double add = fluid_.friction / fluid_.density;
      spectrum_.for_each_mode([&](std::size_t n, const WaveVector&) {
        for (int d = 0; d < Dim; ++d) force[d][n] += add * midpoint_[d][n];
      });
    }
    if (fluid_.inertia) add_advection(force);
  }

  void add_advection(const Modes& force) {
    points_.resize(Dim + 1);
    for (auto& values : points_) values.resize(spectrum_.grid().point_count());
    for (int d = 0; d < Dim; ++d) {
      Complex* const relative = copy(d, midpoint_[d].data());
      relative[0] = 0.0;  // the mesh goes with the mean
      spectrum_.transform().backward(relative, points_[d].data());
    }
    const auto count = static_cast<std::ptrdiff_t>(points_[0].size());
    Complex* const flux = room(0);
    for (int a = 0; a < Dim; ++a) {
      for (int b = a; b < Dim; ++b) {
#pragma omp parallel for schedule(static) if (count >= mesh::parallel_threshold)
        for (std::ptrdiff_t x = 0; x < count; ++x) points_[Dim][x] = points_[a][x] * points_[b][x];
        spectrum_.transform().forward(points_[Dim].data(), flux);
        spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
          if (!spectrum_.has(n)) return;
          force[a][n] -= Complex(0.0, k[b]) * flux[n];
          if (a != b) force[b][n] -= Complex(0.0, k[a]) * flux[n];
        });
      }
    }
  }

  /// Modes of all elements of the gradient but the last, put into room from `first` on.
  void differentiate(const Modes& velocity, Complex** gradient, int first) {
    for (int c = 0; c < gradients; ++c) gradient[c] = room(first + c);
    spectrum_.for_each_mode([&](std::size_t n, const WaveVector& k) {
      for (int c = 0; c < gradients; ++c) gradient[c][n] = Complex(0.0, k[c % Dim]) * velocity[c / Dim][n];
    });
  }
  Complex* room(int n) {
    if (static_cast<int>(rooms_.size()) <= n) rooms_.resize(static_cast<std::size_t>(n) + 1);
    rooms_[static_cast<std::size_t>(n)].resize(spectrum_.mode_count());
    return rooms_[static_cast<std::size_t>(n)].data();
  }
  Complex* copy(int n, const Complex* modes) {
    std::copy(modes, modes + spectrum_.mode_count(), room(n));
    return room(n);
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
  std::vector<std::vector<Complex>> rooms_;
  std::vector<std::vector<double>> points_;
  std::vector<double> row_sums_;
  double mean_gradient_ = 0.0;  // 1/s
};

}  // namespace mesogen::incompressible
