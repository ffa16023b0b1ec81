#include <algorithm>
#include <cmath>
#include <optional>

#include "plugin/plugin_call.hpp"
#include "run/initial_extent.hpp"
#include "run/setup_context.hpp"
#include "solids/surfaces.hpp"
#include "sph/lattice.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

// Of the largest stable step: disordered particles take the shortest waves down up to a tenth faster than a lattice
// does, and diffusion is not alone.
constexpr double diffusion_margin = 0.6;

/// See TimeScheme.
double stable_rate(const std::string& scheme) { return scheme == "midpoint" ? 1.0 : 2.0; }

void publish_physics(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.physics.size(); ++n)
    context.attempt(source.physics[n], [&] {
      const auto& member = setup.physics[n];
      call_plugin(member.type, "publish()", [&] { member.plugin->publish(setup.scene); });
    });
}

void publish_initial_conditions(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.initial.size(); ++n)
    context.attempt(source.initial[n], [&] {
      const auto& member = setup.initial[n];
      call_plugin(member.name, "publish()", [&] { member.plugin->publish(setup.scene); });
    });
  // Of a boundary that refused its parameters nothing more is asked, and with wrong ones nothing is set.
  for (std::size_t n = 0; n < setup.initial.size() && context.problems.empty(); ++n) {
    std::optional<InitialState> state;
    context.attempt(source.initial[n], [&] { state.emplace(initial_state(setup.initial[n], setup)); });
    // Behind walls the boundary says how the field goes on: what it does wrong is its own.
    context.attempt(source.boundary, [&] {
      for (const FieldDeclaration& field : setup.initial[n].plan.fields())
        if (state) setup.scene.initial[field.name] = initial_extent(field, *state, *setup.boundary, setup.smoothing);
    });
  }
}

/// Numbers that vary depend on constants, and constants on them: all tell theirs again. Scales are told later.
void settle_prescribed(SetupContext& context, Problems& problems) {
  if (context.prescribed.empty() || !problems.empty()) return;
  find_prescribed(context, problems);
  if (!problems.empty()) return;
  const Scales told = context.setup.scene.scales;
  publish_physics(context);
  context.setup.scene.scales = told;
}

/// What the solids leave of the lattice.
void place_between_solids(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < source.shapes.size(); ++n)
    context.attempt(source.shapes[n], [&] { setup.confined->solids()[n].prepare(setup.scene); });
  if (!context.problems.empty()) return;
  try {
    ConfinedBoundary::Fluid fluid = setup.confined->place(setup.scene, setup.arrangement);
    setup.arrangement = std::move(fluid.arrangement);
    setup.scene.particle_count = setup.arrangement.count;
    setup.scene.fluid_volume = fluid.volume;
    setup.scene.widest = fluid.widest;
    setup.scene.depth_in_solid = [&confined = *setup.confined](const std::array<double, 3>& at) {
      return confined.depth(at);
    };
  } catch (const Error& error) {
    context.refused = context.refused || error.code() == ExitCode::plugin_refused;
    context.problems.add(source.place("solids"), "solids", error.what());
  }
}

}  // namespace

void describe_scene(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  Scene& scene = setup.scene;
  setup.arrangement = arrange(source);
  scene.dimension = source.dimension();
  scene.precision = source.run.precision;
  std::ranges::copy(source.domain.size, scene.box.begin());
  for (int d = 0; d < scene.dimension; ++d) scene.periodic[d] = setup.boundary->periodic(d);
  scene.solids = setup.confined != nullptr;
  scene.fluid_volume = 1.0;
  for (int d = 0; d < scene.dimension; ++d) scene.fluid_volume *= scene.box[static_cast<std::size_t>(d)];
  scene.spacing = source.particles.spacing;
  scene.smoothing_length = setup.smoothing.smoothing_length;
  scene.support = setup.smoothing.radius();
  scene.particle_count = setup.arrangement.count;
  scene.diffusion_step = diffusion_margin * stable_rate(source.time.scheme) / largest_laplacian(setup);
  publish_physics(context);
  Problems early;  // what is wrong is told once more when the scene is complete
  settle_prescribed(context, early);
  scene.scales = {};  // what was told of an incomplete scene does not count: all tell it again
  if (context.additions.scene) context.additions.scene(scene);
  context.attempt(source.boundary, [&] { setup.boundary->prepare(scene); });
  if (setup.confined != nullptr && context.problems.empty()) place_between_solids(context);
  if (!context.problems.empty()) return;
  settle_prescribed(context, context.problems);
  if (!context.problems.empty()) return;
  publish_initial_conditions(context);
  settle_prescribed(context, context.problems);
  if (!context.problems.empty()) return;
  context.attempt(source.boundary, [&] {
    scene.surfaces =
        wall_surfaces(scene, *setup.boundary, setup.confined != nullptr ? &setup.confined->region() : nullptr);
  });
  context.attempt(source.boundary, [&] { setup.boundary->scales(scene.scales); });
  if (context.problems.empty()) publish_physics(context);
}

void limit_step(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.physics.size(); ++n)
    context.attempt(source.physics[n], [&] { add_step_limits(setup.physics[n], setup, setup.limits); });
}

double largest_laplacian(const Setup& setup) {
  return sph::largest_laplacian(setup.smoothing, setup.scene.spacing, setup.scene.dimension,
                                setup.source.laplacian == "consistent");
}

InitialState initial_state(const Setup::InitialMember& member, const Setup& setup) {
  InitialState::Positions position;
  for (std::size_t d = 0; d < position.size(); ++d) position[d] = setup.arrangement.position[d];
  InitialState state(setup.scene, member.plan, position);
  call_plugin(member.name, "set()", [&] { member.plugin->set(state); });
  for (const FieldDeclaration& field : member.plan.fields())
    for (int c = 0; c < component_count(field.rank, setup.scene.dimension); ++c) {
      const auto values = state.component(field.name, c);
      const auto wrong = std::ranges::find_if_not(values, [](double value) { return std::isfinite(value); });
      if (wrong != values.end())
        throw Error(ExitCode::plugin_refused, "plugin \"" + member.name + "\", set(): component " + std::to_string(c) +
                                                  " of '" + field.name + "' is " + rounded_text(*wrong) +
                                                  " at particle " + std::to_string(wrong - values.begin()) +
                                                  ": set a finite number");
    }
  return state;
}

void add_step_limits(const Setup::PhysicsMember& member, const Setup& setup, StepLimits& limits) {
  for (const PassList::Limit& limit : member.passes.step_limits()) {
    const PluginCall call{.plugin = member.type, .call = "step limit", .subject = limit.rule};
    const double seconds = call_plugin(call, ExitCode::plugin_refused, [&] { return limit.seconds(setup.scene); });
    if (!(seconds > 0.0))
      throw Error(ExitCode::plugin_refused, "plugin \"" + member.type + "\": the limit on the step \"" + limit.rule +
                                                "\" is " + rounded_text(seconds) + " " + setup.source.units.time +
                                                ": it must be above 0");
    limits.add(limit.cause, limit.rule, seconds);
  }
  for (const LinearTerm& term : member.passes.linear_terms())
    if (term.limits_step && term.coefficient > 0.0) limits.add(term.cause, term.rule, term.longest_step(setup.scene));
}

}  // namespace mesogen
