// Where a dissolved substance is at the start: everywhere as much, and more or less of it in round spots,
//
//   c = background + sum of value exp(-r^2 / radius^2),   r the distance to the nearest image of a spot's centre.

#include <cmath>
#include <string>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class SoluteSpots final : public Initial {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.number("background", background_).doc("concentration away from all spots");
    list.rows("spots", spots_)
        .sizes({4})
        .doc(
            "x and y of the centre (m), radius (m) at which a spot has fallen to 1/e, and what it adds to the "
            "background "
            "at its centre, for each spot");
  }

  void plan(InitialPlan& plan) const override {
    for (const auto& spot : spots_)
      if (!(spot[2] > 0.0)) throw BadParameter("spots", "the radius of a spot, its third number, must be above 0");
    plan.sets("solute", Rank::scalar).doc("c: concentration");
  }

  void set(InitialState& state) const override {
    const auto solute = state.component("solute");
    const Scene& scene = state.scene();
    for (std::size_t i = 0; i < solute.size(); ++i) {
      solute[i] = background_;
      for (const auto& spot : spots_) {
        double square = 0.0;
        for (int d = 0; d < 2; ++d) {
          const auto axis = static_cast<std::size_t>(d);
          double way = state.position(d)[i] - spot[axis];
          if (scene.periodic[axis]) way -= scene.box[axis] * std::round(way / scene.box[axis]);
          square += way * way;
        }
        solute[i] += spot[3] * std::exp(-square / (spot[2] * spot[2]));
      }
    }
  }

 private:
  double background_ = 0.0;
  Parameter::Rows spots_;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(SoluteSpots, "solute_spots", "1.0.0", "Dissolved substance at the start, in round spots")
