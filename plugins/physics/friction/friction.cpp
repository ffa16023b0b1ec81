// Linear friction with a substrate: a force density -xi u, as of a film on a surface (Thampi, Golestanian, Yeomans,
// Phys. Rev. E 90, 062307 (2014)).

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
class Friction final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("coefficient", coefficient_)
        .unit("kg/(m3 s)")
        .at_least(0)
        .required()
        .may_vary("friction")
        .doc("xi: force density per velocity");
  }

  void publish(Scene& scene) const override { scene.constants["friction"] = coefficient_; }

  void declare(const Scene& scene, PassList& list) override {
    const double density = scene.constant("density");
    const bool varies = scene.varying.contains("friction");
    LinearTerm& damping = list.damping("velocity", "acceleration", coefficient_, StepCause::friction, "0.25 rho / xi");
    // A flow takes the same friction everywhere in any step, and what differs from it as an explicit force.
    damping.divided_by("density", density)
        .takes_any_step((scene.scales.friction_for_any_step && !varies) || !(density > 0.0));
    if (varies) damping.varies_with("friction", coefficient_);
  }

 private:
  double coefficient_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Friction, "friction", "1.0.0", "Linear friction with a substrate")
