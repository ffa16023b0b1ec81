#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "options.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

void print_plugin(const PluginRegistry& registry, PluginKind kind, const PluginChoice& choice) {
  const auto& plugin = *registry.find(kind, choice.type);
  fmt::print("  {:<24} {} {}: {} ({})\n", choice.section.path(), choice.type, plugin.descriptor->version,
             plugin.file.string(), plugin.instruction_set);
}

void print_steps(const Setup& setup) {
  const auto& time = setup.source.time;
  if (time.step) {
    fmt::print("time            {:.6g} s, in {} steps of {:.6g} s\n", time.end,
               std::ceil(time.end / *time.step * (1.0 - 1e-9)), *time.step);
  } else {
    fmt::print("time            {:.6g} s, step chosen as the run goes, times {:.6g}\n", time.end, time.factor);
  }
  fmt::print("step limits, beside those of the motion\n");
  for (const auto& limit : setup.limits.all()) {
    fmt::print("  {:<46} {:.6g} s", limit.name, limit.seconds);
    if (time.step && *time.step > limit.seconds)
      fmt::print("   time.step is {:.3g} times as long: the run will break down", *time.step / limit.seconds);
    fmt::print("\n");
  }
}

ExitCode check(const CaseOptions& options) {
  const auto registry = load_plugins(options.plugin_folders);
  const auto setup = set_up(options, registry);
  const Case& source = setup->source;
  const Scene& scene = setup->scene;
  const double neighbours = std::numbers::pi * std::pow(scene.support / scene.spacing, 2);
  if (!source.title.empty()) fmt::print("title           {}\n", source.title);
  fmt::print("box             {:.6g} m x {:.6g} m\n", scene.box[0], scene.box[1]);
  fmt::print("particles       {}, {}, spacing {:.6g} m\n", scene.particle_count, source.particles.arrangement,
             scene.spacing);
  if (const auto fitted = fitted_spacing_text(source); !fitted.empty()) fmt::print("                {}\n", fitted);
  fmt::print("kernel          smoothing length {:.6g} m, support {:.6g} m, about {:.0f} neighbours\n",
             scene.smoothing_length, scene.support, neighbours);
  fmt::print("precision       {}\n", scene.precision == Precision::single_precision ? "single" : "double");
  print_steps(*setup);
  fmt::print("stored fields   position{}{} every {:.6g} s\n", setup->output_fields.empty() ? "" : ", ",
             fmt::join(setup->output_fields, ", "), source.output.interval);
  fmt::print("plugins\n");
  print_plugin(registry, PluginKind::kernel, source.kernel);
  print_plugin(registry, PluginKind::boundary, source.boundary);
  for (const auto& choice : source.physics) print_plugin(registry, PluginKind::physics, choice);
  for (const auto& choice : source.observers) print_plugin(registry, PluginKind::observer, choice);
  fmt::print("{} can be run\n", options.file);
  return ExitCode::done;
}

}  // namespace

void add_check(CLI::App& command, Action& action) {
  const auto options = std::make_shared<CaseOptions>();
  auto* const verb = command.add_subcommand("check", "Check a case and tell what a run of it would be; writes nothing");
  add_case(*verb, *options);
  verb->callback([&action, options] { action = [options] { return check(*options); }; });
}

}  // namespace mesogen::app
