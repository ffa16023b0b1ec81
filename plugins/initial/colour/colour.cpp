// A dye that the particles carry, for the observer `mixing`.

#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Colour final : public Initial {
 public:
  void parameters(ParameterList& list) override {
    list.text("type", type_).doc("quarter: 1 where x < Lx/2 and y < Ly/2, else 0").choices({"quarter"}).required();
  }

  void plan(InitialPlan& plan) const override {
    plan.sets("colour", Rank::scalar).doc("share of dye in the particle");
    plan.needs_moving_particles();
  }

  void set(InitialState& state) const override {
    const auto x = state.position(0);
    const auto y = state.position(1);
    const auto colour = state.component("colour");
    const Scene& scene = state.scene();
    for (std::size_t i = 0; i < x.size(); ++i)
      colour[i] = x[i] < 0.5 * scene.box[0] && y[i] < 0.5 * scene.box[1] ? 1.0 : 0.0;
  }

 private:
  std::string type_ = "quarter";
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(Colour, "colour", "1.0.0", "Dye in one quarter of the box")
