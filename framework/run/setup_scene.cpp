// Setting a case up, second part: the scene, as plugins see it and add to it.

#include <algorithm>
#include <cmath>
#include <optional>

#include "plugin/plugin_call.hpp"
#include "run/initial_extent.hpp"
#include "run/setup_builder.hpp"
#include "sph/lattice.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

// Of the largest stable step: disordered particles take the shortest waves down up to a tenth faster than a lattice
// does, and diffusion is not alone.
constexpr double diffusion_margin = 0.6;

/// See TimeScheme.
double stable_rate(const std::string& scheme) { return scheme == "midpoint" ? 1.0 : 2.0; }

}  // namespace

void SetupBuilder::describe_scene() {
  Scene& scene = setup_.scene;
  setup_.arrangement = arrange(source_);
  scene.dimension = source_.dimension();
  scene.precision = source_.run.precision;
  std::ranges::copy(source_.domain.size, scene.box.begin());
  for (int d = 0; d < scene.dimension; ++d) scene.periodic[d] = setup_.boundary->periodic(d);
  scene.spacing = source_.particles.spacing;
  scene.smoothing_length = setup_.smoothing.smoothing_length;
  scene.support = setup_.smoothing.radius();
  scene.particle_count = setup_.arrangement.count;
  scene.diffusion_step =
      diffusion_margin * stable_rate(source_.time.scheme) /
      sph::largest_laplacian(setup_.smoothing, scene.spacing, scene.dimension, source_.laplacian == "consistent");
  publish_physics();
  scene.scales = {};  // what was told of an incomplete scene does not count: all tell it again
  if (additions_.scene) additions_.scene(scene);
  attempt(source_.boundary, [&] { setup_.boundary->prepare(scene); });
  publish_initial_conditions();
  attempt(source_.boundary, [&] { setup_.boundary->scales(scene.scales); });
  if (problems_.empty()) publish_physics();
}

void SetupBuilder::publish_physics() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      call_plugin(member.type, "publish()", [&] { member.plugin->publish(setup_.scene); });
    });
}

void SetupBuilder::declare_physics() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      auto& member = setup_.physics[n];
      call_plugin(member.type, "declare()", [&] { member.plugin->declare(setup_.scene, member.passes); });
    });
  for (const auto& member : setup_.physics)
    for (const auto& [name, value] : member.passes.constants()) setup_.scene.constants[name] = value;
}

void SetupBuilder::limit_step() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] { add_step_limits(setup_.physics[n], setup_, setup_.limits); });
}

void SetupBuilder::publish_initial_conditions() {
  for (std::size_t n = 0; n < setup_.initial.size(); ++n)
    attempt(source_.initial[n], [&] {
      const auto& member = setup_.initial[n];
      call_plugin(member.name, "publish()", [&] { member.plugin->publish(setup_.scene); });
    });
  // Of a boundary that refused its parameters nothing more is asked, and with wrong ones nothing is set.
  for (std::size_t n = 0; n < setup_.initial.size() && problems_.empty(); ++n) {
    std::optional<InitialState> state;
    attempt(source_.initial[n], [&] { state.emplace(initial_state(setup_.initial[n], setup_)); });
    // Behind walls the boundary says how the field goes on: what it does wrong is its own.
    attempt(source_.boundary, [&] {
      for (const FieldDeclaration& field : setup_.initial[n].plan.fields())
        if (state) setup_.scene.initial[field.name] = initial_extent(field, *state, *setup_.boundary, setup_.smoothing);
    });
  }
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
}

}  // namespace mesogen
