// Kolmogorov's force on the fluid: f = F sin(2 pi n y / L) along x. The viscous flow that answers it is
// u = f / (mu (2 pi n / L)^2), whose instability at higher Reynolds numbers is a classic of its own.

#include <cmath>
#include <numbers>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// What is done at particle i, on host and device.
template <class Real>
struct AddWave {
  const double* y;
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  double amplitude, wave_number;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    acceleration(0, i) += Real(amplitude * std::sin(wave_number * y[i])) / density(i);
  }
};

template <class Real, int Dim>
class KolmogorovForce final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("amplitude", amplitude_).unit("N/m3").required().doc("F: largest force per volume");
    list.integer("waves", waves_).unit("1").at_least(1).doc("n: periods along y");
  }

  void declare(const Scene&, PassList& list) override {
    list.pass("Kolmogorov force")
        .reads({"density"})
        .accumulates({"acceleration"})
        .run([this](const PassContext& context) {
          const double k = 2.0 * std::numbers::pi * static_cast<double>(waves_) / context.scene().box[1];
          exec::for_each(context.space(), context.count(),
                         AddWave<Real>{context.position(1), context.read<Real>("density"),
                                       context.write<Real>("acceleration"), amplitude_, k});
        });
  }

 private:
  double amplitude_ = 0.0;
  std::int64_t waves_ = 1;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(KolmogorovForce, "kolmogorov_force", "1.0.0", "Sinusoidal force along x, periodic in y")
