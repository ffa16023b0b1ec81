#include "scene_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace mesogen::testing {

namespace {

std::string section(std::string_view head, std::string_view type, std::string_view keys) {
  return fmt::format("[{}]\ntype = \"{}\"\n{}\n", head, type, keys);
}

/// A plugin that can be used in no dimension is refused when the scene is set up.
int dimension_of(PluginKind kind, std::string_view name, const TestScene& scene, const PluginRegistry& registry) {
  if (scene.dimension > 0) return scene.dimension;
  const LoadedPlugin* const plugin = registry.find(kind, name);
  const DimensionSet usable = plugin == nullptr ? built_dimensions : usable_dimensions(*plugin->descriptor);
  return (usable.empty() ? built_dimensions : usable).list().front();
}

}  // namespace

std::string scene_text(PluginKind kind, std::string_view name, std::string_view keys, const TestScene& scene,
                       const PluginRegistry& registry) {
  const bool tests_boundary = kind == PluginKind::boundary;
  const bool tests_kernel = kind == PluginKind::kernel;
  const std::vector<double> size(static_cast<std::size_t>(dimension_of(kind, name, scene, registry)), scene.length);
  std::string text = fmt::format("[domain]\nsize = [{:.17g}]\n", fmt::join(size, ", "));
  text += section("domain.boundary", tests_boundary ? name : scene.boundary, tests_boundary ? keys : "");
  text += fmt::format("[particles]\nspacing = {:.17g}\narrangement = \"{}\"\n", scene.length / scene.across,
                      scene.arrangement);
  text += section("kernel", tests_kernel ? name : scene.kernel,
                  fmt::format("smoothing_length = 1.3333333333333333\n{}", tests_kernel ? keys : ""));
  if (kind == PluginKind::shape) text += fmt::format("[solids.{}]\nshape = \"{}\"\n{}\n", tested_instance, name, keys);
  if (kind == PluginKind::initial) text += fmt::format("[{}]\n{}\n", name, keys);
  text += "[physics]\n";
  if (kind == PluginKind::physics) text += section(fmt::format("physics.{}", tested_instance), name, keys);
  if (kind == PluginKind::observer) text += section(fmt::format("observers.{}", tested_instance), name, keys);
  text += "[time]\nend = 1e6\nstepping = \"explicit\"\n";
  if (scene.step > 0.0) text += fmt::format("step = {:.17g}\n", scene.step);
  text += fmt::format("[run]\nprecision = \"{}\"\ndevice = \"{}\"\n", to_string(scene.precision), scene.device);
  return text + scene.more + "\n";
}

}  // namespace mesogen::testing
