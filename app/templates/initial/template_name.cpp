// The fluid starts as a shear wave: u = U sin(2 pi y / Ly) along x.

#include <cmath>
#include <numbers>

#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class TemplateNamePlugin final : public Initial {
 public:
  // Keys of its section in a case, [template_name]: unit, range, and a default or required(). Checked before a run.
  void parameters(ParameterList& list) override {
    list.number("speed", speed_).unit("m/s").required().doc("U: largest speed");
  }

  // All fields that it sets. Others are set by sets("order_tensor", Rank::order_tensor): any field that the case has.
  void plan(InitialPlan& plan) const override { plan.sets_velocity("velocity").unit("m/s").doc("u").shown(); }

  // Particle by particle. Random numbers: exec::random_uniform(seed, particle, stream), from mesogen/exec/random.hpp.
  void set(InitialState& state) const override {
    const auto y = state.position(1);
    const auto u = state.component("velocity", 0);
    const double height = state.scene().box[1];
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = speed_ * std::sin(2.0 * std::numbers::pi * y[i] / height);
  }

 private:
  double speed_ = 0.0;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Fluid that starts as a shear wave")
