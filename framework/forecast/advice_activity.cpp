#include <cmath>

#include "forecast/advice_rules.hpp"
#include "forecast/instability.hpp"

namespace mesogen::rules {

namespace {

bool grows(ActiveFluid fluid, const Setup& setup, double activity) {
  fluid.activity = activity;
  return fastest_wave(fluid, setup.scene.box, uniform_director(setup.source)).growth_rate > 0.0;
}

}  // namespace

std::optional<Advice> nothing_grows(const AdviceInput& input) {
  const Setup& setup = input.setup;
  const auto fluid = active_fluid(setup.scene.constants);
  const std::string key = key_of(setup, "activity");
  if (!fluid || fluid->activity == 0.0 || key.empty() || !setup.scene.periodic[0] || !setup.scene.periodic[1] ||
      !uniform_director(setup.source) || grows(*fluid, setup, fluid->activity))
    return std::nullopt;
  // The threshold lies between `below` and `above`.
  double below = fluid->activity;
  double above = below;
  for (int n = 0; n < 60 && !grows(*fluid, setup, above); ++n) {
    below = above;
    above *= 2.0;
  }
  if (!grows(*fluid, setup, above)) return std::nullopt;
  for (int n = 0; n < 40; ++n) {
    const double middle = (below + above) / 2.0;
    (grows(*fluid, setup, middle) ? above : below) = middle;
  }
  return Advice{"nothing_grows",
                fmt::format("the activity, {:.3g} Pa, is below the threshold of {:.3g} Pa in this box: all waves of "
                            "the director decay, and nothing starts to flow",
                            fluid->activity, above),
                {setting(key, 2.0 * above)},
                "the longest waves grow and the fluid flows by itself; a larger box lowers the threshold too"};
}

}  // namespace mesogen::rules
