#pragma once

// What the flow does on the mesh, for a scene: one object a run.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "advection.hpp"
#include "flow_loops.hpp"
#include "mesogen/mesh/pass_spectrum.hpp"
#include "mesogen/plugin/context.hpp"
#include "momentum.hpp"

namespace mesogen::incompressible {

struct Numerics {
  int corrections = 0;  ///< of a fit of modes to particles, see mesh::ParticleSpectrum::fit
  double shift = 0.0;   ///< how fast unevenness is taken away, in mean velocity gradients
};

template <class Real, int Dim>
class MeshFlow {
 public:
  using Spectrum = mesh::PassSpectrum<Dim, Real>;
  using Modes = std::array<Complex*, Dim>;

  MeshFlow(const mesh::Grid<Dim>& grid, double particle_spacing, const Fluid& fluid, const Numerics& numerics)
      : grid_(grid), spacing_(particle_spacing), fluid_(fluid), numerics_(numerics), momentum_(grid, fluid) {}

  /// How far a shift may take a particle in one step, in spacings.
  static constexpr double farthest_shift = 0.1;

  Momentum<Dim>& momentum() { return momentum_; }
  /// Root mean square of the velocity's gradient at the midpoint of the step, 1/s.
  [[nodiscard]] double mean_gradient() const { return mean_gradient_; }

  /// Where the mesh begins at the start of the step, m: it goes with the mean velocity, as a particle would, so that
  /// particles cross it only as fast as they move through the fluid around them. For checkpoints.
  [[nodiscard]] std::span<double> origin() { return origin_; }

  /// To be called before all below: they run where passes do. A checkpoint is read earlier.
  void run_where(const PassContext& context) {
    if (mesh_) return;
    mesh_.emplace(grid_, context);
    momentum_.move_to(mesh_->spectrum.memory());
  }

  /// Velocity and its gradient as they will be at the middle of the step, at the particles.
  void to_midpoint(const PassContext& context) {
    if (context.step_size() == 0.0) origin_ = {};
    here_ = origin_;
    const auto mean = mean_of(momentum_.velocity());
    for (int d = 0; d < Dim; ++d) here_[d] += 0.5 * context.step_size() * mean[d];
    locate(context);
    auto& modes = spectrum().modes();
    if (context.step_size() == 0.0) {
      fit(context.read<Real>("velocity"), mesh_->midpoint.write());
      momentum_.start(modes, context.time(), mesh_->midpoint.read());
    }
    momentum_.velocity_at(modes, context.time(), mesh_->midpoint.write());
    mean_gradient_ = incompressible::mean_gradient<Dim>(modes, mesh_->midpoint.read());
    const PutFlow<Real, Dim> put{context.write<Real>("velocity"), context.write<Real>("velocity_gradient"),
                                 context.write<Real>("density"), Real(fluid_.density)};
    spectrum().template evaluate<Dim + gradients>(VelocityAndGradient<Dim>{mesh_->midpoint.read()}, put);
  }

  /// The forces of the others, at the midpoint, into the momentum equation.
  void add_forces(const PassContext& context) {
    locate(context);
    find_acceleration(context);
    momentum_.take(spectrum().modes(), context.time(), mesh_->work.read());
  }

  /// p at the particles: what takes the divergence out of the forces.
  void pressure(const PassContext& context) {
    locate(context);
    find_acceleration(context);
    spectrum().template evaluate<1>(PressureOf<Dim>{mesh_->work.read(), fluid_.density},
                                    PutScalar<Real>{context.write<Real>("pressure")});
  }

  /// The flow at the end of the step, where the particles have gone.
  void to_end(const PassContext& context) {
    const auto mean = mean_of(mesh_->midpoint.read());
    for (int d = 0; d < Dim; ++d) {
      origin_[d] += context.step_size() * mean[d];
      origin_[d] -= grid_.length[d] * std::floor(origin_[d] / grid_.length[d]);
    }
    here_ = origin_;
    locate(context);
    momentum_.advance_to(spectrum().modes(), context.time());
    spectrum().template evaluate<Dim>(VelocityOf<Dim>{momentum_.velocity()},
                                      PutVelocity<Real, Dim>{context.write<Real>("velocity")});
  }

  /// The gradient of the velocity that the particles have, for readers.
  void velocity_gradient(const PassContext& context) {
    here_ = {};
    locate(context);
    fit(context.read<Real>("velocity"), mesh_->work.write());
    spectrum().template evaluate<gradients>(ProjectedGradient<Dim>{mesh_->work.read()},
                                            PutGradient<Real, Dim>{context.write<Real>("velocity_gradient")});
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
    spectrum().template fit<components>(Components<Real, components>{q}, mesh_->work.write(), numerics_.corrections);
    using Derivatives = TensorDerivatives<Real, Dim, components, Spreads>;
    Derivatives derivatives{mesh_->work.read(),
                            diffusivity * step_size,
                            0.0,
                            q,
                            context.write<Real>("order_tensor_gradient"),
                            context.write<Real>("order_tensor_laplacian"),
                            {}};
    const double shortest = std::pow(smallest_cutoff(spectrum().kept()), 2);
    derivatives.below = shortest * limited(derivatives.scale * shortest);
    if constexpr (Spreads) derivatives.spreading = find_spreading(context);
    spectrum().template evaluate<Derivatives::all>(derivatives, derivatives);
  }

  /// Moves particles from where they are dense to where they are sparse.
  void spread_particles(const PassContext& context) {
    locate(context);
    const auto spreading = find_spreading(context);
    spectrum().template evaluate<Dim>(spreading, spreading);
  }

 private:
  static constexpr int gradients = gradient_elements<Dim>;

  /// All that lies where the passes run.
  struct OnMesh {
    Spectrum spectrum;
    VectorModes<Dim> midpoint;  // the velocity
    VectorModes<Dim> work;
    exec::Array<Complex> uneven;
    exec::Array<double> mean;

    OnMesh(const mesh::Grid<Dim>& grid, const PassContext& context)
        : spectrum(grid, context.device_mesh(), context.sharing()),
          midpoint(grid.mode_count(), spectrum.memory()),
          work(grid.mode_count(), spectrum.memory()),
          uneven(spectrum.memory()),
          mean(spectrum.memory()) {
      mean.resize(Dim);
    }
  };
  [[nodiscard]] Spectrum& spectrum() { return mesh_->spectrum; }

  Spreading<Real, Dim> find_spreading(const PassContext& context) {
    mesh_->uneven.resize(spectrum().mode_count());
    spectrum().unevenness(mesh_->uneven.device(exec::Access::read_write));
    const double step = context.step_size();
    double rate = numerics_.shift * mean_gradient_;
    if (step > 0.0) rate = std::min(rate, 0.5 / step);
    const double fastest = step > 0.0 ? farthest_shift * spacing_ / step : 0.0;
    return {rate, static_cast<Real>(fastest), mesh_->uneven.device(), context.write<Real>("shift_velocity")};
  }

  void locate(const PassContext& context) {
    if (located_ == context.positions_version() && located_from_ == here_) return;
    std::array<const double*, Dim> position{};
    for (int d = 0; d < Dim; ++d) position[d] = context.position(d);
    spectrum().locate(position, context.count(), here_);
    located_ = context.positions_version();
    located_from_ = here_;
  }

  void fit(const FieldView<const Real>& vector, const Modes& modes) {
    spectrum().template fit<Dim>(Components<Real, Dim>{vector}, modes, numerics_.corrections);
  }

  // f / rho - div(u u), u relative to the mesh, and what friction is to be added back, because the momentum equation
  // takes it implicitly: to `work`.
  void find_acceleration(const PassContext& context) {
    const Modes force = mesh_->work.write();
    const auto midpoint = mesh_->midpoint.read();
    fit(context.read<Real>("acceleration"), force);
    if (fluid_.friction > 0.0)
      spectrum().modes().for_each(AddModes<Dim>{midpoint, force, fluid_.friction / fluid_.density});
    if (!fluid_.inertia) return;
    spectrum().with_transform(
        [&](auto& transform) { subtract_advection<Real, Dim>(transform, VelocityWithoutMean<Dim>{midpoint}, force); });
  }

  std::array<double, Dim> mean_of(const std::array<const Complex*, Dim>& velocity) {
    exec::for_each(spectrum().space(), 1, CopyMean<Dim>{velocity, mesh_->mean.device(exec::Access::write)},
                   "the mean velocity");
    std::array<double, Dim> mean{};
    std::ranges::copy(mesh_->mean.host(), mean.begin());
    return mean;
  }

  mesh::Grid<Dim> grid_;
  double spacing_;
  Fluid fluid_;
  Numerics numerics_;
  Momentum<Dim> momentum_;
  std::optional<OnMesh> mesh_;
  std::array<double, Dim> origin_{};  // of the mesh at the start of the step, m
  std::array<double, Dim> here_{};    // where it is now
  std::uint64_t located_ = 0;
  std::array<double, Dim> located_from_{};
  double mean_gradient_ = 0.0;  // 1/s
};

}  // namespace mesogen::incompressible
