#include "scene_text.hpp"

#include <fmt/format.h>

namespace mesogen::testing {

namespace {

std::string section(std::string_view head, std::string_view type, std::string_view keys) {
  return fmt::format("[{}]\ntype = \"{}\"\n{}\n", head, type, keys);
}

}  // namespace

std::string scene_text(PluginKind kind, std::string_view name, std::string_view keys, const TestScene& scene) {
  const bool tests_boundary = kind == PluginKind::boundary;
  const bool tests_kernel = kind == PluginKind::kernel;
  std::string text = fmt::format("[domain]\nsize = [{0:.17g}, {0:.17g}]\n", scene.length);
  text += section("domain.boundary", tests_boundary ? name : scene.boundary, tests_boundary ? keys : "");
  text += fmt::format("[particles]\nspacing = {:.17g}\narrangement = \"{}\"\n", scene.length / scene.across,
                      scene.arrangement);
  text += section("kernel", tests_kernel ? name : scene.kernel,
                  fmt::format("smoothing_length = 1.3333333333333333\n{}", tests_kernel ? keys : ""));
  if (kind == PluginKind::initial) text += fmt::format("[{}]\n{}\n", name, keys);
  text += "[physics]\n";
  if (kind == PluginKind::physics) text += section(fmt::format("physics.{}", tested_instance), name, keys);
  if (kind == PluginKind::observer) text += section(fmt::format("observers.{}", tested_instance), name, keys);
  text += "[time]\nend = 1e6\n";
  if (scene.step > 0.0) text += fmt::format("step = {:.17g}\n", scene.step);
  text += fmt::format("[run]\nprecision = \"{}\"\ndevice = \"{}\"\n",
                      scene.precision == Precision::single_precision ? "single" : "double", scene.device);
  return text + scene.more + "\n";
}

}  // namespace mesogen::testing
