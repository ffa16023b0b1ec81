// Linear friction with a substrate: a force density -xi u, as of a film on a surface (Thampi, Golestanian, Yeomans,
// Phys. Rev. E 90, 062307 (2014)).

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct Drag {
  FieldView<const Real> velocity, density;
  FieldView<Real> acceleration;
  Real coefficient;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int d = 0; d < Dim; ++d) acceleration(d, i) -= coefficient / density(i) * velocity(d, i);
  }
};

template <class Real, int Dim>
class Friction final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("coefficient", coefficient_)
        .unit("kg/(m3 s)")
        .at_least(0)
        .required()
        .doc("xi: force density per velocity");
  }

  void publish(Scene& scene) const override { scene.constants["friction"] = coefficient_; }

  void declare(const Scene& scene, PassList& list) override {
    if (coefficient_ > 0.0 && scene.constants.contains("density") && !scene.scales.friction_for_any_step)
      list.step_limit(StepCause::friction, "0.25 rho / xi",
                      [this](const Scene& run) { return 0.25 * run.constant("density") / coefficient_; });
    list.pass("friction")
        .reads({"velocity", "density"})
        .accumulates({"acceleration"})
        .idle_if(coefficient_ == 0.0)
        .run([this](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         Drag<Real, Dim>{context.read<Real>("velocity"), context.read<Real>("density"),
                                         context.write<Real>("acceleration"), Real(coefficient_)});
        });
  }

 private:
  double coefficient_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Friction, "friction", "1.0.0", "Linear friction with a substrate")
