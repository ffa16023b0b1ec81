#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "check_facts.hpp"

namespace mesogen::app {

namespace {

/// A whole number, in full as far as a double counts.
std::string count_text(double count) {
  return count < 1e15 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

std::string plugin_text(const PluginRegistry& registry, PluginKind kind, const PluginChoice& choice) {
  const auto& plugin = *registry.find(kind, choice.type);
  return fmt::format("  {:<24} {} {}: {} ({})\n", choice.section.path(), choice.type, plugin.descriptor->version,
                     plugin.file.string(), plugin.instruction_set);
}

std::string plugins_text(const Case& source, const PluginRegistry& registry) {
  std::string text = "plugins\n" + plugin_text(registry, PluginKind::kernel, source.kernel) +
                     plugin_text(registry, PluginKind::boundary, source.boundary);
  for (const auto& choice : source.shapes) text += plugin_text(registry, PluginKind::shape, choice);
  for (const auto& choice : source.initial) text += plugin_text(registry, PluginKind::initial, choice);
  for (const auto& choice : source.physics) text += plugin_text(registry, PluginKind::physics, choice);
  for (const auto& choice : source.observers) text += plugin_text(registry, PluginKind::observer, choice);
  return text;
}

/// Volume of a ball of radius 1: its area in a plane.
double unit_ball(int dimension) {
  return std::pow(std::numbers::pi, 0.5 * dimension) / std::tgamma(0.5 * dimension + 1.0);
}

std::string scene_text(const Setup& setup) {
  const Case& source = setup.source;
  const Scene& scene = setup.scene;
  const double neighbours = unit_ball(scene.dimension) * std::pow(scene.support / scene.spacing, scene.dimension);
  const std::string& length = source.units.length;
  std::string text;
  if (!source.title.empty()) text += fmt::format("title           {}\n", source.title);
  std::string box;
  for (const double edge : source.domain.size)
    box += fmt::format("{}{:.6g} {}", box.empty() ? "" : " x ", edge, length);
  text += fmt::format("box             {}\n", box);
  text += fmt::format("particles       {}, {}, spacing {:.6g} {}\n", scene.particle_count, source.particles.arrangement,
                      scene.spacing, length);
  if (const auto fitted = fitted_spacing_text(source); !fitted.empty())
    text += fmt::format("                {}\n", fitted);
  text += fmt::format("kernel          smoothing length {0:.6g} {3}, support {1:.6g} {3}, about {2:.0f} neighbours\n",
                      scene.smoothing_length, scene.support, neighbours, length);
  text += fmt::format("precision       {}\n", to_string(scene.precision));
  return text;
}

// What is unstable grows at least so long before it shows.
constexpr double many_steps = 4.0;

std::string steps_text(const Setup& setup, const StepForecast& steps) {
  const auto& time = setup.source.time;
  const std::string& unit = setup.source.units.time;
  std::string text;
  if (time.step) {
    text += fmt::format("time            {0:.6g} {3}, in {1} steps of {2:.6g} {3}{4}\n", time.end,
                        count_text(steps.expected), *time.step, unit,
                        steps.expected * *time.step > 1.000001 * time.end ? " or less" : "");
  } else {
    text += fmt::format("time            {:.6g} {}, step chosen during the run, multiplied by {:.6g}\n", time.end, unit,
                        time.factor);
  }
  std::string stages;
  for (const auto& [field, number] : steps.stages)
    stages += fmt::format("{}{} stages for {}", stages.empty() ? "" : ", ", number, field);
  text += fmt::format("stepping        {}\n", stages.empty() ? "explicit" : "stabilised: " + stages);
  for (const Prescribed& one : setup.prescribed) {
    if (!setup.scene.varying.contains(one.field())) continue;
    std::string largest;
    for (const double value : one.largest) largest += fmt::format("{}{:.6g}", largest.empty() ? "" : ", ", value);
    const std::string of = setup.source.units.text(one.parameter.unit_text);
    text += fmt::format("varies          {}, up to {}{}: {}\n", one.field(), largest, of == "1" ? "" : " " + of,
                        shown(one));
  }
  text += "limits on the step, in addition to those of the motion\n";
  for (const auto& limit : setup.limits.all()) {
    if (!std::isfinite(limit.seconds)) continue;
    text += fmt::format("  {:<46} {:.6g} {}", limit.text, limit.seconds, unit);
    if (limit.text == steps.limit) text += "   limits the step";
    if (time.step && *time.step > limit.seconds)
      text += fmt::format("   time.step is {:.3g} times as long: {} break down", *time.step / limit.seconds,
                          steps.expected < many_steps ? "a longer run would" : "the run will");
    text += '\n';
  }
  if (!steps.fixed && steps.speed > 0.0 && steps.limit_at_speed != steps.limit)
    text += fmt::format("  {:<46} {:.6g} {}   limits the step at {:.3g} {}\n", steps.limit_at_speed, steps.at_speed,
                        unit, steps.speed, setup.source.units.text("m/s"));
  return text;
}

std::string numbers_text(const std::vector<SceneNumber>& numbers) {
  if (numbers.empty()) return {};
  std::string text = "numbers\n";
  for (const SceneNumber& number : numbers)
    text += fmt::format("  {:<27} {:>9} {:<4} {}\n", number.name, fmt::format("{:.4g}", number.value),
                        number.unit == "1" ? "" : number.unit, number.meaning);
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.2g} s", seconds);
  if (seconds < 99.5 * 60.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 72.0 * 3600.0) return fmt::format("{:.0f} h", seconds / 3600.0);
  return fmt::format("{:.0f} days", seconds / 86400.0);
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

std::string run_text(const Setup& setup, const CheckFacts& facts) {
  std::string text = "a run\n";
  const char* const or_more = facts.steps.fixed ? "" : " or more";
  text += fmt::format("  steps           {}{}\n", count_text(facts.steps.expected), or_more);
  if (facts.time) {
    const TimeForecast& time = *facts.time;
    text += fmt::format("  wall time       {}{} with {} thread{}: {:.3g} ms a step (from {} steps)\n",
                        duration_text(time.wall), or_more, time.threads, time.threads == 1 ? "" : "s", 1e3 * time.step,
                        time.timed_steps);
  } else {
    text += fmt::format("  wall time       not measured: {}\n", facts.not_timed);
  }
  const double peak = facts.memory.peak();
  text += fmt::format("  memory          {}", bytes_text(peak));
  if (facts.memory_available > 0.0 && peak > facts.memory_available)
    text += fmt::format(", more than the {} that are available here", bytes_text(facts.memory_available));
  text += fmt::format("\n  disk            {}: {} frames of {}, {} checkpoints of {}\n", bytes_text(facts.disk),
                      count_text(facts.frames), bytes_text(facts.frame_bytes), count_text(facts.checkpoints),
                      bytes_text(facts.checkpoint_bytes));
  text += fmt::format("  stored fields   position{}{} every {:.6g} {}\n", setup.output_fields.empty() ? "" : ", ",
                      fmt::join(setup.output_fields, ", "), setup.source.output.interval, setup.source.units.time);
  return text;
}

/// What following a piece of advice changes, " -> " between before and after.
std::string change_text(const Setup& setup, const CheckFacts& facts, const AdviceFacts& one) {
  std::vector<std::string> changes;
  const auto note = [&](const char* what, double before, double after, const auto& text) {
    if (std::abs(after - before) > 0.05 * before)
      changes.push_back(fmt::format("{} {} -> {}", what, text(before), text(after)));
  };
  note("particles", setup.scene.particle_count, static_cast<double>(one.particles), count_text);
  note("steps", facts.steps.expected, one.steps, count_text);
  note("memory", facts.memory.peak(), one.memory, bytes_text);
  note("disk", facts.disk, one.disk, bytes_text);
  return fmt::format("{}", fmt::join(changes, ", "));
}

std::string advice_text(const Setup& setup, const CheckFacts& facts) {
  if (facts.advice.empty()) return {};
  std::string text = "advice\n";
  for (const AdviceFacts& one : facts.advice) {
    text += fmt::format("  {}\n", one.advice.finding);
    if (!one.advice.settings.empty())
      text += fmt::format("      --set {}\n", fmt::join(one.advice.settings, " --set "));
    text += fmt::format("      {}\n", one.advice.gain);
    if (const std::string change = change_text(setup, facts, one); !change.empty())
      text += fmt::format("      {}\n", change);
  }
  return text;
}

}  // namespace

std::string check_text(const Setup& setup, const PluginRegistry& registry, const CheckFacts& facts) {
  return scene_text(setup) + steps_text(setup, facts.steps) + numbers_text(facts.numbers) + run_text(setup, facts) +
         advice_text(setup, facts) + plugins_text(setup.source, registry);
}

}  // namespace mesogen::app
