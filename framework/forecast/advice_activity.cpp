#include <algorithm>
#include <cmath>
#include <numbers>

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
  return Advice{
      "nothing_grows",
      fmt::format("the activity, {0:.3g} {2}, is below the threshold of {1:.3g} {2} in this box: all waves of "
                  "the director decay, and nothing starts to flow",
                  fluid->activity, above, setup.source.units.text("Pa")),
      {setting(key, 2.0 * above)},
      "the longest waves grow and the fluid flows by itself; a larger box lowers the threshold too"};
}

// Small order of the wave number k grows at the rate lambda zeta / (2 mu) - Gamma (A + K k^2), aligned by the flow that
// it drives: strong activity has order even where the nematic itself has none.
std::optional<Advice> no_order(const AdviceInput& input) {
  const Setup& setup = input.setup;
  const std::string key = key_of(setup, "bulk.A");
  const double a = published(setup, "bulk_A");
  const double c = published(setup, "bulk_C");
  const double activity = published(setup, "activity");
  if (key.empty() || a < 0.0 || activity == 0.0) return std::nullopt;
  const double k = 2.0 * std::numbers::pi / std::max(setup.scene.box[0], setup.scene.box[1]);
  const double decay = published(setup, "rotational_diffusivity") * (a + published(setup, "elastic_constant") * k * k);
  if (published(setup, "flow_alignment") * activity > 2.0 * published(setup, "viscosity") * decay) return std::nullopt;
  // Those of an order of 1.
  const double wanted = c > 0.0 ? 2.0 * c : a > 0.0 ? a : 1.0;
  std::vector<std::string> settings{setting(key, -wanted)};
  if (!(c > 0.0)) settings.push_back(setting(key_of(setup, "bulk.C"), wanted / 2.0));
  return Advice{
      "no_order",
      fmt::format("{}, {:.3g} {}, is not below 0: the order decays, and with it all that the activity acts on", key, a,
                  setup.source.units.text("Pa")),
      std::move(settings), "the nematic keeps an order of 1"};
}

}  // namespace mesogen::rules
