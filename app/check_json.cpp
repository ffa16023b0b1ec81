#include <cmath>

#include "check_facts.hpp"
#include "json.hpp"

namespace mesogen::app {

namespace {

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// As an integer, as far as a double counts them.
Json whole_number(double value) {
  return std::abs(value) <= 9007199254740992.0 ? Json(static_cast<std::int64_t>(value)) : number_or_null(value);
}

Json scene_json(const Setup& setup) {
  const Scene& scene = setup.scene;
  return {{"box", setup.source.domain.size},
          {"particles", scene.particle_count},
          {"arrangement", setup.source.particles.arrangement},
          {"spacing", scene.spacing},
          {"smoothing_length", scene.smoothing_length},
          {"support", scene.support},
          {"precision", to_string(scene.precision)},
          {"constants", scene.constants}};
}

Json steps_json(const Setup& setup, const StepForecast& steps) {
  Json limits = Json::array();
  for (const auto& limit : setup.limits.all())
    if (std::isfinite(limit.seconds)) limits.push_back({{"name", limit.text}, {"seconds", limit.seconds}});
  return {{"end", setup.source.time.end},
          {"fixed", steps.fixed},
          {"limits", limits},
          {"stepping", steps.stages.empty() ? "explicit" : "stabilised"},
          {"stages", steps.stages},
          {"binds", steps.limit},
          {"step", number_or_null(steps.first)},
          {"speed", steps.speed},
          {"binds_at_speed", steps.limit_at_speed},
          {"step_at_speed", number_or_null(steps.at_speed)},
          {"steps_at_rest", whole_number(steps.at_rest)},
          {"steps_at_least", whole_number(steps.expected)}};
}

Json time_json(const TimeForecast& time) {
  return {{"threads", time.threads},     {"timed_steps", time.timed_steps},
          {"start", time.start},         {"step", time.step},
          {"sorting", time.sorting},     {"sortings", time.sortings},
          {"observing", time.observing}, {"writing", time.writing},
          {"wall", time.wall},           {"cpu", time.cpu}};
}

Json memory_json(const CheckFacts& facts) {
  const auto items = [](const std::vector<MemoryForecast::Item>& all) {
    Json list = Json::array();
    for (const auto& item : all) list.push_back({{"what", item.what}, {"bytes", std::round(item.bytes)}});
    return list;
  };
  return {{"peak", std::round(facts.memory.peak())},
          {"available", facts.memory_available},
          {"lasting", items(facts.memory.lasting)},
          {"now_and_then", items(facts.memory.now_and_then)}};
}

Json plugin_json(const PluginRegistry& registry, PluginKind kind, const PluginChoice& choice) {
  const auto& plugin = *registry.find(kind, choice.type);
  return {{"section", choice.section.path()},
          {"type", choice.type},
          {"version", plugin.descriptor->version},
          {"file", plugin.file.string()},
          {"instruction_set", plugin.instruction_set}};
}

Json plugins_json(const Case& source, const PluginRegistry& registry) {
  Json all = Json::array();
  all.push_back(plugin_json(registry, PluginKind::kernel, source.kernel));
  all.push_back(plugin_json(registry, PluginKind::boundary, source.boundary));
  for (const auto& choice : source.shapes) all.push_back(plugin_json(registry, PluginKind::shape, choice));
  for (const auto& choice : source.initial) all.push_back(plugin_json(registry, PluginKind::initial, choice));
  for (const auto& choice : source.physics) all.push_back(plugin_json(registry, PluginKind::physics, choice));
  for (const auto& choice : source.observers) all.push_back(plugin_json(registry, PluginKind::observer, choice));
  return all;
}

Json advice_json(const std::vector<AdviceFacts>& advice) {
  Json all = Json::array();
  for (const AdviceFacts& one : advice)
    all.push_back({{"name", one.advice.name},
                   {"finding", one.advice.finding},
                   {"settings", one.advice.settings},
                   {"gain", one.advice.gain},
                   {"particles", one.particles},
                   {"steps", one.steps},
                   {"memory", std::round(one.memory)},
                   {"disk", one.disk}});
  return all;
}

}  // namespace

std::string check_json(const Setup& setup, const PluginRegistry& registry, const CheckFacts& facts) {
  Json numbers = Json::object();
  for (const SceneNumber& number : facts.numbers)
    numbers[number.name] = {{"value", number.value}, {"unit", number.unit}, {"meaning", number.meaning}};
  Json all = {{"title", setup.source.title},
              {"scene", scene_json(setup)},
              {"steps", steps_json(setup, facts.steps)},
              {"numbers", numbers},
              {"time", facts.time ? time_json(*facts.time) : Json(nullptr)}};
  if (!facts.time) all["not_timed"] = facts.not_timed;
  all["breaks_down"] = facts.breaks_down;
  all["problems"] = facts.problems.text();
  all["warnings"] = facts.warnings;
  all["memory"] = memory_json(facts);
  all["disk"] = {{"frames", facts.frames},
                 {"frame", facts.frame_bytes},
                 {"checkpoints", facts.checkpoints},
                 {"checkpoint", facts.checkpoint_bytes},
                 {"fields", setup.output_fields}};
  all["advice"] = advice_json(facts.advice);
  all["plugins"] = plugins_json(setup.source, registry);
  return document(all);
}

}  // namespace mesogen::app
