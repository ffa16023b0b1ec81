// The velocity of the fluid when a run starts: at rest, uniform, or the flow of a stream function psi that is a sum of
// waves, u = (d psi / dy, -d psi / dx), whose divergence is 0.

#include <algorithm>
#include <cmath>

#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/waves.hpp"

namespace {

using namespace mesogen;

class Velocity final : public Initial {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.text("type", type_).doc("how the fluid moves at the start").choices({"rest", "uniform", "modes"}).required();
    list.numbers("value", value_)
        .unit("m/s")
        .doc("velocity everywhere")
        .sizes({2})
        .required()
        .only_with("type", {"uniform"});
    list.rows("modes", modes_)
        .doc(
            "rows mx, my, amplitude (m^2/s), phase (rad): cosine waves of the stream function, with mx and my waves in "
            "the box along x and y")
        .sizes({4})
        .required()
        .only_with("type", {"modes"});
  }

  void plan(InitialPlan& plan) const override { plan.sets_velocity("velocity").unit("m/s").doc("u").shown(); }

  void publish(Scene& scene) override { waves_ = box_waves("modes", modes_, scene); }

  void set(InitialState& state) const override {
    const auto x = state.position(0);
    const auto y = state.position(1);
    const auto u = state.component("velocity", 0);
    const auto v = state.component("velocity", 1);
    if (type_ == "uniform") {
      std::fill(u.begin(), u.end(), value_[0]);
      std::fill(v.begin(), v.end(), value_[1]);
    }
    for (const BoxWave& wave : waves_)
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double slope = -wave.amplitude * std::sin(wave.argument(x[i], y[i]));
        u[i] += slope * wave.ky;
        v[i] -= slope * wave.kx;
      }
  }

 private:
  std::string type_ = "rest";
  std::vector<double> value_ = {0.0, 0.0};
  Parameter::Rows modes_;
  std::vector<BoxWave> waves_;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(Velocity, "velocity", "1.0.0", "Velocity of the fluid: at rest, uniform, or waves")
