// Setting a case up, first part: its plugins and their parameters.

#include <algorithm>

#include "plugin/plugin_call.hpp"
#include "run/choose_backend.hpp"
#include "run/setup_builder.hpp"
#include "run/smoothing.hpp"
#include "sph/standard_passes.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

/// What a section that is called after no initial condition most likely means: "; did you mean \"director\"?". Empty if
/// it is called after one, or if nothing is like it.
std::string hint_on_section(const CaseSection& section, const PluginRegistry& registry) {
  const std::string name = section.name();
  if (registry.find(PluginKind::initial, name) != nullptr) return {};
  for (const auto& [kind, group] :
       {std::pair(PluginKind::physics, "physics"), std::pair(PluginKind::observer, "observers")})
    if (registry.find(kind, section.type()) != nullptr)
      return "; did you mean \"" + std::string(group) + "." + name + "\"?";
  return did_you_mean(name, registry.names(PluginKind::initial));
}

}  // namespace

template <class Make>
auto SetupBuilder::make(PluginKind kind, const PluginChoice& choice, Make&& made) -> decltype(made(choice.type)) {
  if (choice.type.empty()) return nullptr;
  // Where the size of the box was refused, the dimension that is meant is not known: a plugin of another is no problem.
  const LoadedPlugin* const found = registry_.find(kind, choice.type);
  if (source_.domain.size.empty() && found != nullptr &&
      !usable_dimensions(*found->descriptor).contains(source_.dimension()))
    return nullptr;
  try {
    return made(choice.type);
  } catch (const Error& error) {
    refused_ = refused_ || error.code() == ExitCode::plugin_refused;
    problems_.add(choice.type_place, choice.type_key, error.what());
    return nullptr;
  }
}

void SetupBuilder::read(const PluginChoice& choice, const ParameterList& list) {
  choice.read(list, problems_);
  resolved_.add(choice.section, list);
}

void SetupBuilder::choose_backend() {
  BackendChoice choice = mesogen::choose_backend(source_, registry_);
  setup_.backend = choice.backend;
  setup_.why_on_host = std::move(choice.why_on_host);
  if (!choice.problem.empty()) problems_.add(source_.place("run.device"), "run.device", choice.problem);
}

void SetupBuilder::make_plugins() {
  const int dimension = source_.dimension();
  const auto simple = [&](const PluginChoice& choice, auto& plugin) {
    if (!plugin) return;
    bool understood = false;
    attempt(choice, [&] {
      ParameterList list;
      call_plugin(choice.type, "parameters()", [&] { plugin->parameters(list); });
      read(choice, list);
      understood = true;
    });
    if (!understood) plugin.reset();
  };
  setup_.boundary = make(PluginKind::boundary, source_.boundary, [&](const std::string& type) {
    return registry_.make_boundary(type, dimension, source_.units.length);
  });
  simple(source_.boundary, setup_.boundary);
  setup_.kernel = make(PluginKind::kernel, source_.kernel,
                       [&](const std::string& type) { return registry_.make_kernel(type, dimension); });
  simple(source_.kernel, setup_.kernel);
  for (const PluginChoice& choice : source_.initial) {
    auto plugin = make(PluginKind::initial, choice, [&](const std::string& name) {
      if (const std::string hint = hint_on_section(choice.section, registry_); !hint.empty())
        throw Error(ExitCode::bad_case, "unknown section or key" + hint);
      return registry_.make_initial(name, dimension);
    });
    initial_missing_ = initial_missing_ || !plugin;
    simple(choice, plugin);
    if (!plugin) continue;
    plugin->unit = [units = source_.units](std::string_view si) { return units.text(si); };
    setup_.initial.push_back({choice.type, std::move(plugin), {}});
    attempt(choice, [&] {
      auto& member = setup_.initial.back();
      call_plugin(choice.type, "plan()", [&] { member.plugin->plan(member.plan); });
    });
  }
  for (const PluginChoice& choice : source_.physics) {
    const bool on_device = !setup_.backend->on_host() && registry_.has_cuda(choice.type);
    auto plugin = make(PluginKind::physics, choice, [&](const std::string& type) {
      return on_device ? registry_.make_physics_for_cuda(type, source_.run.precision, dimension)
                       : registry_.make_physics(type, source_.run.precision, dimension);
    });
    simple(choice, plugin);
    if (plugin) setup_.physics.push_back({"physics." + choice.instance, std::move(plugin), {}, choice.type, on_device});
  }
  setup_.instruction_sets = "derivatives " + (setup_.backend->on_host() ? sph::instruction_set() : std::string("cuda"));
  for (const auto& member : setup_.physics)
    if (const LoadedPlugin* const plugin = registry_.find(PluginKind::physics, member.type))
      setup_.instruction_sets += ", " + member.type + " " + (member.on_device ? "cuda" : plugin->instruction_set);
  for (std::size_t n = 0; n < source_.observers.size(); ++n) {
    const PluginChoice& choice = source_.observers[n];
    auto plugin = make(PluginKind::observer, choice,
                       [&](const std::string& type) { return registry_.make_observer(type, dimension); });
    simple(choice, plugin);
    if (plugin)
      setup_.observers.push_back({choice.instance, std::move(plugin), {}, source_.timings[n], {}, choice.type});
  }
}

void SetupBuilder::choose_kernel() {
  if (!setup_.kernel || !(source_.particles.spacing > 0.0) || !(source_.smoothing_length_ratio > 0.0)) return;
  bool made = false;
  attempt(source_.kernel, [&] {
    setup_.smoothing.shape = call_plugin(source_.kernel.type, "shape()", [&] { return setup_.kernel->shape(); });
    made = true;
  });
  if (!made) return;
  if (const std::string problem = setup_.smoothing.shape.problem(); !problem.empty()) {
    problems_.add(source_.kernel.type_place, source_.kernel.type_key, "this kernel cannot be used: " + problem);
    return;
  }
  setup_.smoothing = smoothing_of(source_, std::move(setup_.smoothing.shape));
  if (const std::string problem = range_problem(source_, setup_.smoothing); !problem.empty())
    problems_.add(source_.place("particles.spacing"), "particles.spacing", problem);
  const bool walls = setup_.boundary && !setup_.boundary->periodic(shortest_axis(source_));
  if (const std::string problem = support_problem(source_, setup_.smoothing, walls); !problem.empty())
    problems_.add(source_.place("kernel.smoothing_length"), "kernel.smoothing_length", problem);
}

}  // namespace mesogen
