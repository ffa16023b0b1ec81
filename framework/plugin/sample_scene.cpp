#include "plugin/sample_scene.hpp"

#include "plugin/plugin_call.hpp"

namespace mesogen {

Scene sample_scene(const PluginRegistry& registry, int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.particle_count = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d) {
    scene.box[d] = 1.0;
    scene.particle_count *= 10;
  }
  scene.fluid_volume = 1.0;
  scene.spacing = 0.1;
  scene.smoothing_length = 0.13;
  scene.support = 0.4;
  scene.diffusion_step = 1e-3;
  for (const std::string& name : registry.names(PluginKind::physics)) {
    try {
      const auto physics = registry.make_physics(name, Precision::double_precision, scene.dimension);
      ParameterList list;
      call_plugin(name, "parameters()", [&] { physics->parameters(list); });
      call_plugin(name, "publish()", [&] { physics->publish(scene); });
    } catch (const Error&) {
      // What is wrong with another plugin is not asked here.
    }
  }
  return scene;
}

PassList sample_declaration(Physics& physics, std::string_view plugin, const PluginRegistry& registry, int dimension) {
  PassList list;
  call_plugin(plugin, "declare()", [&] { physics.declare(sample_scene(registry, dimension), list); });
  return list;
}

}  // namespace mesogen
