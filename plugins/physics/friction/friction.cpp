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

  void constants(Constants& constants) const override { constants["friction"] = coefficient_; }

  void passes(PassList& list) override {
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

  void step_limits(const Scene& scene, StepLimits& limits) const override {
    const auto density = scene.constants.find("density");
    if (scene.scales.friction_for_any_step) return;
    if (coefficient_ > 0.0 && density != scene.constants.end())
      limits.add("friction: 0.25 rho / xi", 0.25 * density->second / coefficient_);
  }

 private:
  double coefficient_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Friction, "friction", "1.0.0", "Linear friction with a substrate")
