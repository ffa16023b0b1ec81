#include <cmath>

#include "forecast/advice_rules.hpp"
#include "initial/arrangement.hpp"

namespace mesogen::rules {

namespace {

// The order of a defect's core, within 2.5 xi, is wrong by this times (dx / xi)^2 (root of the mean square; measured
// against the exact profile with the quintic kernel and the consistent Laplacian, 1.2 to 4 spacings in a core).
constexpr double error_of_core = 0.066;

constexpr double good_spacings = 2.0;  // in a core: 1.7 % wrong
constexpr double many_spacings = 4.0;  // 0.4 %
constexpr double rounding = 1e-9;      // of a spacing that is computed to give so many

// Where it takes more than these, a smaller spacing is no help.
constexpr double most_particles = 2e7;

/// xi = sqrt(K / |A|) in spacings; 0 where there is no nematic, or one without order and so without defects.
double core_in_spacings(const Setup& setup) {
  const double bulk = -published(setup, "bulk_A");
  return bulk > 0.0 ? std::sqrt(published(setup, "elastic_constant") / bulk) / setup.scene.spacing : 0.0;
}

double percent_wrong(double spacings) { return 100.0 * error_of_core / (spacings * spacings); }

/// The largest spacing with at least so many in a core that fits the box.
std::string spacing_setting(const Setup& setup, double spacings) {
  const double length = setup.scene.box[0];
  const double wanted = setup.scene.spacing * core_in_spacings(setup) / spacings;
  const double first = std::ceil(length / wanted * (1.0 - rounding));
  Case source = setup.source;
  const auto fits = [&](double columns) {
    source.particles.spacing = length / columns;
    return arrangement_problem(source).empty();
  };
  double columns = first;
  while (columns < 2.0 * first && !fits(columns)) ++columns;
  return fmt::format("particles.spacing={:.12g}", length / columns);
}

}  // namespace

std::optional<Advice> core_under_resolved(const AdviceInput& input) {
  const double spacings = core_in_spacings(input.setup);
  if (!(spacings > 0.0) || spacings >= good_spacings * (1.0 - rounding)) return std::nullopt;
  const std::string finding =
      fmt::format("a defect's core, xi, is {:.2g} spacings: the order in it is wrong by {}", spacings,
                  spacings < 1.0 ? "more than 6 %" : fmt::format("some {:.2g} %", percent_wrong(spacings)));
  const double particles = input.setup.scene.particle_count * std::pow(good_spacings / spacings, 2);
  if (particles > most_particles)
    return Advice{
        "core_under_resolved",
        finding,
        {},
        fmt::format("cores of {:.2g} spacings take {:.2g} particles: a smaller box or larger elastic constant "
                    "helps",
                    good_spacings, particles)};
  return Advice{"core_under_resolved",
                finding,
                {spacing_setting(input.setup, good_spacings)},
                fmt::format("it is wrong by some {:.2g} %", percent_wrong(good_spacings))};
}

// Only where the active length keeps enough spacings too.
std::optional<Advice> core_over_resolved(const AdviceInput& input) {
  const double spacings = core_in_spacings(input.setup);
  if (spacings < many_spacings) return std::nullopt;
  const double bulk = -published(input.setup, "bulk_A");
  if (std::abs(published(input.setup, "activity")) > bulk) return std::nullopt;
  const double coarser = spacings / good_spacings;
  return Advice{
      "core_over_resolved",
      fmt::format("a defect's core, xi, is {:.2g} spacings: more than its order needs", spacings),
      {spacing_setting(input.setup, good_spacings)},
      fmt::format("the order in cores is wrong by some {:.2g} % instead of {:.2g} %, with {:.2g} times fewer particles",
                  percent_wrong(good_spacings), percent_wrong(spacings), coarser * coarser)};
}

// Of the kernels here each needs a support of some four spacings; below three, Taylor-Green vortices of 30 x 30
// particles are wrong by 3 to 4 % in place of 1 %.
std::optional<Advice> few_neighbours(const AdviceInput& input) {
  const Scene& scene = input.setup.scene;
  const double spacings = scene.support / scene.spacing;
  if (spacings >= 3.0 || input.setup.graph->transport().velocity.empty()) return std::nullopt;
  const double per_length = input.setup.smoothing.shape.support();
  return Advice{"few_neighbours",
                fmt::format("the kernel reaches {:.2g} spacings: particles that flow see too few neighbours; the "
                            "answer is wrong by some per cent",
                            spacings),
                {setting("kernel.smoothing_length", 4.0 / per_length)},
                "with a reach of four spacings they stay evenly spread, and steps are longer"};
}

}  // namespace mesogen::rules
