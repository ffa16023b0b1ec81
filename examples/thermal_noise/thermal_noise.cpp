// Thermal fluctuations of the order tensor: what random kicks the relaxation of Q must come with so that a nematic in
// equilibrium visits its states with Boltzmann's probability (fluctuation and dissipation).
//
// A particle of volume V has the free energy V (A (Q11^2 + Q12^2) + ...), and with H as in beris_edwards
// dQ/dt = Gamma H = -Gamma / (2 V) dF/dQ. So each component is kicked by sqrt(Gamma kT / V) dW.
//
// Each number depends only on the seed, the particle's id and the step: the same for any number of threads and any
// order of storage, and a run resumed from a checkpoint draws those that it would have drawn.

#include <cmath>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Two independent numbers of mean 0 and variance 1 (Box and Muller 1958).
struct NormalPair {
  double first, second;

  MESOGEN_HOST_DEVICE NormalPair(std::int64_t seed, std::int64_t id, std::int64_t step) {
    // 1 - u lies in (0, 1]: the logarithm is finite. Streams 2 n and 2 n + 1 belong to step n.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - exec::random_uniform(seed, id, 2 * step)));
    const double angle = 2.0 * std::numbers::pi * exec::random_uniform(seed, id, 2 * step + 1);
    first = radius * std::cos(angle);
    second = radius * std::sin(angle);
  }
};

template <class Real>
struct Kick {
  const std::int64_t* id;
  FieldView<const Real> volume;
  FieldView<Real> rate;
  double strength;  // Gamma kT / dt
  std::int64_t seed, step;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const NormalPair normal(seed, id[i], step);
    const double scale = std::sqrt(strength / static_cast<double>(volume(i)));
    rate(0, i) += Real(scale * normal.first);
    rate(1, i) += Real(scale * normal.second);
  }
};

template <class Real, int Dim>
requires(Dim == 2) class ThermalNoise final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("temperature", temperature_).unit("N").at_least(0).required().doc("kT per depth of the film");
    list.integer("seed", seed_).unit("1").doc("seed of the random numbers");
  }

  void declare(const Scene& scene, PassList& list) override {
    if (!scene.constants.contains("rotational_diffusivity"))
      throw Error(ExitCode::bad_case,
                  "thermal_noise needs the rotational diffusivity of a nematic: add a [physics.*] section with type = "
                  "\"beris_edwards\"");
    gamma_ = scene.constant("rotational_diffusivity");
    list.pass("thermal noise")
        .reads({"volume"})
        .accumulates({"order_tensor_rate"})
        .run([this](const PassContext& context) {
          // Before the first step rates are evaluated without one: there is nothing to kick yet.
          if (!(context.step_size() > 0.0)) return;
          exec::for_each(
              context.space(), context.count(),
              Kick<Real>{context.id(), context.read<Real>("volume"), context.write<Real>("order_tensor_rate"),
                         gamma_ * temperature_ / context.step_size(), seed_, context.step()});
        });
  }

 private:
  double temperature_ = 0.0;
  std::int64_t seed_ = 1;
  double gamma_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(ThermalNoise, "thermal_noise", "1.0.0", "Thermal fluctuations of the order tensor")
