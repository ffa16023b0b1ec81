#include "case/framework_keys.hpp"
#include "case/given_value.hpp"
#include "plugin/plugin_call.hpp"
#include "run/setup_context.hpp"
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

template <class Make>
auto make(SetupContext& context, PluginKind kind, const PluginChoice& choice, Make&& made)
    -> decltype(made(choice.type)) {
  if (choice.type.empty()) return nullptr;
  // Where the size of the box was refused, the dimension that is meant is not known: a plugin of another is no problem.
  const Case& source = context.setup.source;
  const LoadedPlugin* const found = context.registry.find(kind, choice.type);
  if (source.domain.size.empty() && found != nullptr &&
      !usable_dimensions(*found->descriptor).contains(source.dimension()))
    return nullptr;
  try {
    return made(choice.type);
  } catch (const Error& error) {
    context.refused = context.refused || error.code() == ExitCode::plugin_refused;
    context.problems.add(choice.type_place, choice.type_key, error.what());
    return nullptr;
  }
}

void refuse_varying(const PluginChoice& choice, const ParameterList& list) {
  for (const Parameter& parameter : list.all())
    if (parameter.given)
      throw Error(ExitCode::plugin_refused, "plugin \"" + choice.type + "\": the parameter \"" + parameter.name +
                                                "\" may not vary: only numbers of physics plugins may");
}

/// Reads the parameters of a plugin, which goes if they are wrong. `prescribed`: of a physics plugin, receives what
/// varies.
template <class Plugin>
void read_parameters(SetupContext& context, const PluginChoice& choice, Plugin& plugin,
                     std::vector<Prescribed>* prescribed = nullptr) {
  if (!plugin) return;
  bool understood = false;
  context.attempt(choice, [&] {
    ParameterList list;
    call_plugin(choice.type, "parameters()", [&] { plugin->parameters(list); });
    if (prescribed == nullptr) refuse_varying(choice, list);
    choice.read(list, context.problems);
    if (prescribed != nullptr) {
      for (Prescribed& one : prescribed_in("physics." + choice.instance, choice.section, list))
        prescribed->push_back(std::move(one));
      for (const Parameter& parameter : list.all()) {
        if (!parameter.given) continue;
        context.may_vary[parameter.field_name].push_back(choice.section.full_key(parameter.name));
        if (!parameter.given->value)
          context.numbers.push_back({"physics." + choice.instance, choice.section, parameter});
      }
    }
    context.resolved.add(choice.section, list);
    understood = true;
  });
  if (!understood) plugin.reset();
}

void make_boundary_and_kernel(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  setup.boundary = make(context, PluginKind::boundary, source.boundary, [&](const std::string& type) {
    return context.registry.make_boundary(type, source.dimension(), source.units.length);
  });
  read_parameters(context, source.boundary, setup.boundary);
  setup.kernel = make(context, PluginKind::kernel, source.kernel,
                      [&](const std::string& type) { return context.registry.make_kernel(type, source.dimension()); });
  read_parameters(context, source.kernel, setup.kernel);
}

/// With solids the boundary is that of the box and theirs together.
void make_solids(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  if (source.shapes.empty()) return;
  std::vector<Solid> solids;
  for (std::size_t n = 0; n < source.shapes.size(); ++n) {
    const PluginChoice& choice = source.shapes[n];
    auto shape = make(context, PluginKind::shape, choice,
                      [&](const std::string& name) { return context.registry.make_shape(name, source.dimension()); });
    read_parameters(context, choice, shape);
    Case::Solid keys = source.solids[n];
    context.resolved.add(choice.section, case_keys::solid(keys));
    if (shape) solids.emplace_back(choice.section.path(), std::move(shape), std::move(keys));
  }
  if (!setup.boundary || solids.size() < source.shapes.size()) return;
  auto confined = std::make_unique<ConfinedBoundary>(std::move(setup.boundary), std::move(solids), source.units.length);
  setup.confined = confined.get();
  setup.boundary = std::move(confined);
}

void make_initial(SetupContext& context, const PluginChoice& choice) {
  Setup& setup = context.setup;
  auto plugin = make(context, PluginKind::initial, choice, [&](const std::string& name) {
    if (const std::string hint = hint_on_section(choice.section, context.registry); !hint.empty())
      throw Error(ExitCode::bad_case, "unknown section or key" + hint);
    return context.registry.make_initial(name, setup.source.dimension());
  });
  context.initial_missing = context.initial_missing || !plugin;
  read_parameters(context, choice, plugin);
  if (!plugin) return;
  plugin->unit = [units = setup.source.units](std::string_view si) { return units.text(si); };
  setup.initial.push_back({choice.type, std::move(plugin), {}});
  context.attempt(choice, [&] {
    auto& member = setup.initial.back();
    call_plugin(choice.type, "plan()", [&] { member.plugin->plan(member.plan); });
  });
}

void make_physics(SetupContext& context, const PluginChoice& choice) {
  Setup& setup = context.setup;
  const bool on_device = !setup.backend->on_host() && context.registry.has_cuda(choice.type);
  const Precision precision = setup.source.run.precision;
  const int dimension = setup.source.dimension();
  auto plugin = make(context, PluginKind::physics, choice, [&](const std::string& type) {
    return on_device ? context.registry.make_physics_for_cuda(type, precision, dimension)
                     : context.registry.make_physics(type, precision, dimension);
  });
  read_parameters(context, choice, plugin, &context.prescribed);
  if (plugin) setup.physics.push_back({"physics." + choice.instance, std::move(plugin), {}, choice.type, on_device});
}

void make_observer(SetupContext& context, const PluginChoice& choice, const ObserverTiming& timing) {
  auto plugin = make(context, PluginKind::observer, choice, [&](const std::string& type) {
    return context.registry.make_observer(type, context.setup.source.dimension());
  });
  read_parameters(context, choice, plugin);
  if (plugin) context.setup.observers.push_back({choice.instance, std::move(plugin), {}, timing, {}, choice.type});
}

std::string instruction_sets(const Setup& setup, const PluginRegistry& registry) {
  const std::string on_device = "cuda " + setup.backend->architecture();
  std::string all = "derivatives " + (setup.backend->on_host() ? sph::instruction_set() : on_device);
  for (const auto& member : setup.physics)
    if (const LoadedPlugin* const plugin = registry.find(PluginKind::physics, member.type))
      all += ", " + member.type + " " + (member.on_device ? on_device : plugin->instruction_set);
  return all;
}

}  // namespace

void make_plugins(SetupContext& context) {
  const Case& source = context.setup.source;
  make_boundary_and_kernel(context);
  make_solids(context);
  for (const PluginChoice& choice : source.initial) make_initial(context, choice);
  for (const PluginChoice& choice : source.physics) make_physics(context, choice);
  for (std::size_t n = 0; n < source.observers.size(); ++n)
    make_observer(context, source.observers[n], source.timings[n]);
  context.setup.instruction_sets = instruction_sets(context.setup, context.registry);
}

void choose_kernel(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  if (!setup.kernel || !(source.particles.spacing > 0.0) || !(source.smoothing_length_ratio > 0.0)) return;
  bool made = false;
  context.attempt(source.kernel, [&] {
    setup.smoothing.shape = call_plugin(source.kernel.type, "shape()", [&] { return setup.kernel->shape(); });
    made = true;
  });
  if (!made) return;
  if (const std::string problem = setup.smoothing.shape.problem(); !problem.empty()) {
    context.problems.add(source.kernel.type_place, source.kernel.type_key, "this kernel cannot be used: " + problem);
    return;
  }
  setup.smoothing = smoothing_of(source, std::move(setup.smoothing.shape));
  if (const std::string problem = range_problem(source, setup.smoothing); !problem.empty())
    context.problems.add(source.place("particles.spacing"), "particles.spacing", problem);
  const bool walls = setup.boundary && !setup.boundary->periodic(shortest_axis(source));
  if (const std::string problem = support_problem(source, setup.smoothing, walls); !problem.empty())
    context.problems.add(source.place("kernel.smoothing_length"), "kernel.smoothing_length", problem);
}

}  // namespace mesogen
