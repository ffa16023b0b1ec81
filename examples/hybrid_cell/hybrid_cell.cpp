// The director of a hybrid cell: its angle changes linearly from one wall to the other, as it is at rest between walls
// that anchor it in different directions (one elastic constant).

#include <cmath>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class HybridCell final : public Initial {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.number("angle_low", low_)
        .unit("degree")
        .at_least(-360)
        .at_most(360)
        .required()
        .doc("angle of the director to the x axis where y = 0");
    list.number("angle_high", high_)
        .unit("degree")
        .at_least(-360)
        .at_most(360)
        .required()
        .doc("the same at the far end of the y axis");
    list.number("order", order_).at_least(0).doc("magnitude q of the order tensor");
  }

  void plan(InitialPlan& plan) const override {
    plan.sets("order_tensor", Rank::order_tensor).doc("Q of a director that turns along y").shown();
  }

  void publish(Scene& scene) override {
    const double turns = (high_ - low_) / 180.0;
    if (scene.periodic[1] && turns != std::round(turns))
      throw BadParameter("angle_high",
                         "must differ from angle_low by a multiple of 180 degrees where the box is periodic along y, "
                         "or else there must be walls: boundary = { type = \"walls\", axes = [\"y\"] }");
  }

  void set(InitialState& state) const override {
    const auto y = state.position(1);
    const auto q11 = state.component("order_tensor", 0);
    const auto q12 = state.component("order_tensor", 1);
    const double degree = std::numbers::pi / 180.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double angle = degree * (low_ + (high_ - low_) * y[i] / state.scene().box[1]);
      q11[i] = order_ * std::cos(2.0 * angle);
      q12[i] = order_ * std::sin(2.0 * angle);
    }
  }

 private:
  double low_ = 0.0;
  double high_ = 0.0;
  double order_ = 1.0;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(HybridCell, "hybrid_cell", "1.0.0", "Director that turns evenly from wall to wall")
