// Setting a case up, second part: the scene, as plugins see it and add to it.

#include <algorithm>
#include <cmath>

#include "initial/distortion.hpp"
#include "initial/fields.hpp"
#include "plugin/plugin_call.hpp"
#include "simulation/rounded_text.hpp"
#include "simulation/setup_builder.hpp"
#include "sph/lattice.hpp"

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
  scene.dimension = 2;
  scene.precision = source_.run.precision;
  scene.box = {source_.domain.size[0], source_.domain.size[1], 0.0};
  for (int d = 0; d < 2; ++d) scene.periodic[d] = setup_.boundary->periodic(d);
  scene.spacing = source_.particles.spacing;
  scene.smoothing_length = setup_.smoothing.smoothing_length;
  scene.support = setup_.smoothing.radius();
  scene.particle_count = setup_.arrangement.count;
  scene.diffusion_step =
      diffusion_margin * stable_rate(source_.time.scheme) /
      sph::largest_laplacian(setup_.smoothing, scene.spacing, scene.dimension, source_.laplacian == "consistent");
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      call_plugin(member.type, "constants()", [&] { member.plugin->constants(scene.constants); });
    });
  if (additions_.scene) additions_.scene(scene);
  attempt(source_.boundary, [&] { setup_.boundary->prepare(scene); });
  find_distortion();
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      call_plugin(member.type, "scales()", [&] { member.plugin->scales(scene, scene.scales); });
    });
  attempt(source_.boundary, [&] { setup_.boundary->scales(scene.scales); });
  if (source_.velocity.given) {
    const auto velocity = initial_velocity(source_, setup_.arrangement);
    for (std::size_t i = 0; i < velocity[0].size(); ++i)
      scene.scales.speed = std::max(scene.scales.speed, std::hypot(velocity[0][i], velocity[1][i]));
  }
  const auto for_each_physics = [&](const auto& action) {
    for (std::size_t n = 0; n < setup_.physics.size(); ++n)
      attempt(source_.physics[n], [&] { action(setup_.physics[n]); });
  };
  for_each_physics([&](const Setup::PhysicsMember& member) {
    call_plugin(member.type, "prepare()", [&] { member.plugin->prepare(scene); });
  });
  if (!problems_.empty()) return;
  for_each_physics([&](const Setup::PhysicsMember& member) {
    call_plugin(member.type, "constants()", [&] { member.plugin->constants(scene.constants); });
  });
  for_each_physics([&](const Setup::PhysicsMember& member) { add_step_limits(member, setup_, setup_.limits); });
}

// Of a boundary that refused its parameters nothing more is asked.
void SetupBuilder::find_distortion() {
  if (!source_.director.given || !problems_.empty()) return;
  attempt(source_.boundary, [&] {
    setup_.scene.distortion =
        distortion_of(initial_order_tensor(source_, setup_.arrangement), setup_.arrangement.position, setup_.scene,
                      *setup_.boundary, setup_.smoothing);
  });
}

void add_step_limits(const Setup::PhysicsMember& member, const Setup& setup, StepLimits& limits) {
  call_plugin(member.type, "step_limits()", [&] {
    member.plugin->step_limits(setup.scene, limits);
    for (const auto& limit : limits.all())
      if (!(limit.seconds > 0.0))
        throw Error(ExitCode::plugin_refused, "the limit on the step \"" + limit.name + "\" is " +
                                                  rounded_text(limit.seconds) + " " + setup.source.units.time +
                                                  ": it must be above 0");
  });
}

}  // namespace mesogen
