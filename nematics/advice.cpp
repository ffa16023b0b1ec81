#include "mesogen/nematics/advice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/nematics/instability.hpp"
#include "mesogen/nematics/numbers.hpp"
#include "mesogen/text/formatted.hpp"

namespace mesogen::nematics {

namespace {

// The order of a defect's core, within 2.5 xi, is wrong by this times (dx / xi)^2 (root of the mean square; measured
// against the exact profile with the quintic kernel and the consistent Laplacian, 1.2 to 4 spacings in a core).
constexpr double error_of_core = 0.066;

constexpr double good_spacings = 2.0;  // in a core: 1.7 % wrong
constexpr double many_spacings = 4.0;  // 0.4 %
constexpr double rounding = 1e-9;      // of a spacing that is computed to give so many

// Where it takes more than these, a smaller spacing is no help.
constexpr double most_particles = 2e7;

/// xi = sqrt(K / |A|) in spacings; 0 for a nematic without order, which has no defects.
double core_in_spacings(const Scene& scene) {
  const double bulk = -scene.constant("bulk_A");
  return bulk > 0.0 ? std::sqrt(scene.constant("elastic_constant") / bulk) / scene.spacing : 0.0;
}

double percent_wrong(double spacings) { return 100.0 * error_of_core / (spacings * spacings); }

std::string setting(const std::string& key, double value) { return formatted("%s=%.6g", key.c_str(), value); }

/// The largest spacing with at least so many in a core that fits the box.
std::string spacing_setting(const AdviceContext& context, double spacings) {
  const double wanted = context.scene.spacing * core_in_spacings(context.scene) / spacings;
  return formatted("particles.spacing=%.12g", context.fitting_spacing(wanted * (1.0 + rounding)));
}

void advise_on_few_spacings(const AdviceContext& context, double spacings, std::vector<Suggestion>& list) {
  // With elastic stress a passive nematic whose cores are 1.6 spacings gained 4 % of the energy that it had lost.
  const bool elastic_flow = context.scene.constants.contains("elastic_stress");
  const std::string finding =
      formatted("the core of a defect, xi, is only %.2g spacings: the order in cores is wrong by ", spacings) +
      (spacings < 1.0 ? "more than 6 %" : formatted("some %.2g %%", percent_wrong(spacings))) +
      (elastic_flow ? ", and the energy of a passive nematic may rise" : "");
  const double particles = static_cast<double>(context.scene.particle_count) * std::pow(good_spacings / spacings, 2);
  if (particles > most_particles) {
    list.push_back(
        {"core_under_resolved",
         finding,
         {},
         formatted(
             "cores of %.2g spacings need %.2g particles; instead, choose a smaller box or a larger elastic constant",
             good_spacings, particles)});
  } else {
    list.push_back({"core_under_resolved",
                    finding,
                    {spacing_setting(context, good_spacings)},
                    formatted("the order in cores is wrong by some %.2g %%", percent_wrong(good_spacings))});
  }
}

bool grows(ActiveFluid fluid, const Scene& scene, double activity) {
  fluid.activity = activity;
  return fastest_wave(fluid, scene.box, uniform_director(scene)).growth_rate > 0.0;
}

}  // namespace

void advise_on_cores(const AdviceContext& context, std::vector<Suggestion>& list) {
  const double spacings = core_in_spacings(context.scene);
  if (spacings > 0.0 && spacings < good_spacings * (1.0 - rounding))
    return advise_on_few_spacings(context, spacings, list);
  // Fewer are enough only where the active length keeps enough spacings too.
  if (spacings < many_spacings || std::abs(context.scene.constant("activity")) > -context.scene.constant("bulk_A"))
    return;
  const double coarser = spacings / good_spacings;
  const double length = active_length(context.scene);
  if (!context.scene.endless() && length > 0.0 && length < few_in_active_length * coarser * context.scene.spacing)
    return;
  list.push_back(
      {"core_over_resolved",
       formatted("the core of a defect, xi, is %.2g spacings, finer than needed for the order in it", spacings),
       {spacing_setting(context, good_spacings)},
       formatted("the order in cores is wrong by some %.2g %% instead of %.2g %%, with %.2g times fewer particles",
                 percent_wrong(good_spacings), percent_wrong(spacings), coarser * coarser)});
}

// Small order of the wave number k grows at the rate lambda zeta / (2 mu) - Gamma (A + K k^2), aligned by the flow that
// it drives: strong activity has order even where the nematic itself has none.
void advise_on_order(const AdviceContext& context, std::vector<Suggestion>& list) {
  const Scene& scene = context.scene;
  const double a = scene.constant("bulk_A");
  const double c = scene.constant("bulk_C");
  const double activity = scene.constant("activity");
  if (a < 0.0 || activity == 0.0) return;
  const double k = 2.0 * std::numbers::pi / std::max(scene.box[0], scene.box[1]);
  const double decay = scene.constant("rotational_diffusivity") * (a + scene.constant("elastic_constant") * k * k);
  if (scene.constant("flow_alignment") * activity > 2.0 * scene.constant("viscosity") * decay) return;
  // Those of an order of 1.
  const double wanted = c > 0.0 ? 2.0 * c : a > 0.0 ? a : 1.0;
  const std::string key = context.section + ".bulk.A";
  std::vector<std::string> settings{setting(key, -wanted)};
  if (!(c > 0.0)) settings.push_back(setting(context.section + ".bulk.C", wanted / 2.0));
  list.push_back({"no_order",
                  formatted("%s is %.3g %s, not below 0: the order decays, so the activity has nothing to act on",
                            key.c_str(), a, context.unit("Pa").c_str()),
                  std::move(settings), "the nematic keeps an order of 1"});
}

void advise_on_activity(const AdviceContext& context, std::vector<Suggestion>& list) {
  const Scene& scene = context.scene;
  const auto fluid = active_fluid(scene.constants);
  if (!fluid || fluid->activity == 0.0 || !scene.endless() || !uniform_director(scene) ||
      grows(*fluid, scene, fluid->activity))
    return;
  // The threshold lies between `below` and `above`.
  double below = fluid->activity;
  double above = below;
  for (int n = 0; n < 60 && !grows(*fluid, scene, above); ++n) {
    below = above;
    above *= 2.0;
  }
  if (!grows(*fluid, scene, above)) return;
  for (int n = 0; n < 40; ++n) {
    const double middle = (below + above) / 2.0;
    (grows(*fluid, scene, middle) ? above : below) = middle;
  }
  const std::string unit = context.unit("Pa");
  list.push_back({"nothing_grows",
                  formatted("the activity, %.3g %s, is below the threshold of %.3g %s in this box: all waves of the "
                            "director decay, and no flow starts",
                            fluid->activity, unit.c_str(), above, unit.c_str()),
                  {setting(context.section + ".activity", 2.0 * above)},
                  "the longest waves grow, and the fluid flows by itself; a larger box also lowers the threshold"});
}

}  // namespace mesogen::nematics
