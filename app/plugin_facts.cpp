#include "plugin_facts.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "plugin/plugin_call.hpp"
#include "plugin/sample_scene.hpp"

namespace mesogen::app {

namespace {

template <class Plugin>
void ask_keys(PluginFacts& facts, Plugin& plugin) {
  ParameterList list;
  call_plugin(facts.name, "parameters()", [&] { plugin.parameters(list); });
  facts.keys = declared_keys(list);
}

void ask(PluginFacts& facts, Kernel& kernel) {
  ask_keys(facts, kernel);
  facts.shape = call_plugin(facts.name, "shape()", [&] { return kernel.shape(); });
}

void ask(PluginFacts& facts, Boundary& boundary) { ask_keys(facts, boundary); }

void ask(PluginFacts& facts, Shape& shape) { ask_keys(facts, shape); }

void ask(PluginFacts& facts, Initial& initial) {
  ask_keys(facts, initial);
  InitialPlan plan;
  call_plugin(facts.name, "plan()", [&] { initial.plan(plan); });
  facts.fields.assign(plan.fields().begin(), plan.fields().end());
}

void ask(PluginFacts& facts, Physics& physics, const PluginRegistry& registry) {
  ask_keys(facts, physics);
  const int dimension = facts.dimensions.front();
  Scene scene;
  scene.dimension = dimension;
  PassList list;
  try {
    call_plugin(facts.name, "publish()", [&] { physics.publish(scene); });
    list = sample_declaration(physics, facts.name, registry, dimension);
    Constants constants = scene.constants;
    constants.insert(list.constants().begin(), list.constants().end());
    for (const auto& [name, value] : constants) facts.constants.push_back(name);
  } catch (const Error& error) {
    // A plugin may need its required parameters for this.
    facts.not_described = error.what();
    return;
  }
  facts.fields.assign(list.fields().begin(), list.fields().end());
  facts.passes.assign(list.passes().begin(), list.passes().end());
  for (auto& pass : facts.passes) pass.body = nullptr;
  for (auto& field : facts.fields) field.watch = nullptr;
  facts.transport = list.transport();
}

void ask(PluginFacts& facts, Observer& observer, const PluginRegistry& registry) {
  ask_keys(facts, observer);
  // The plan may depend on the scene; any will do to name fields and quantities.
  const Scene scene = sample_scene(registry, facts.dimensions.front());
  ObserverPlan plan;
  try {
    call_plugin(facts.name, "plan()", [&] { observer.plan(scene, plan); });
  } catch (const Error& error) {
    facts.not_described = error.what();
    return;
  }
  facts.reads = plan.read_list();
  facts.reads_if_present = plan.optional_list();
  facts.reads_otherwise = plan.otherwise_list();
  facts.quantities.assign(plan.quantities().begin(), plan.quantities().end());
  facts.follows = plan.follows();
}

}  // namespace

PluginFacts plugin_facts(const PluginRegistry& registry, const LoadedPlugin& plugin) {
  const auto& descriptor = *plugin.descriptor;
  PluginFacts facts;
  facts.kind = descriptor.kind;
  facts.name = descriptor.name;
  facts.version = descriptor.version;
  facts.summary = descriptor.summary;
  facts.abi = descriptor.abi;
  facts.build_tag = descriptor.build_tag;
  facts.file = plugin.file.string();
  facts.instruction_set = plugin.instruction_set;
  facts.cuda = facts.kind == PluginKind::physics && registry.has_cuda(facts.name);
  facts.dimensions = usable_dimensions(descriptor).list();
  facts.any_dimension = descriptor.dimensions == DimensionSet(AllDimensions{});
  const int dimension = registry.smallest_dimension(facts.kind, facts.name);
  switch (facts.kind) {
    case PluginKind::kernel: ask(facts, *registry.make_kernel(facts.name, dimension)); break;
    case PluginKind::boundary: ask(facts, *registry.make_boundary(facts.name, dimension)); break;
    case PluginKind::shape: ask(facts, *registry.make_shape(facts.name, dimension)); break;
    case PluginKind::initial: ask(facts, *registry.make_initial(facts.name, dimension)); break;
    case PluginKind::physics:
      ask(facts, *registry.make_physics(facts.name, Precision::double_precision, dimension), registry);
      break;
    case PluginKind::observer: ask(facts, *registry.make_observer(facts.name, dimension), registry); break;
  }
  return facts;
}

std::vector<PluginFacts> all_plugin_facts(const PluginRegistry& registry) {
  std::vector<PluginFacts> all;
  for (const auto& plugin : registry.all()) {
    try {
      all.push_back(plugin_facts(registry, plugin));
    } catch (const Error& error) {
      fmt::print(stderr, "warning: left out: {}: {}\n", plugin.file.string(), error.what());
    }
  }
  return all;
}

std::string_view place_in_case(PluginKind kind) {
  switch (kind) {
    case PluginKind::kernel: return "[kernel]";
    case PluginKind::boundary: return "boundary = { type = ..., ... }";
    case PluginKind::shape: return "[solids.NAME]";
    case PluginKind::initial: return "a section called after the plugin";
    case PluginKind::physics: return "[physics.NAME]";
    case PluginKind::observer: return "[observers.NAME]";
  }
  return "";
}

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::begin: return "begin";
    case Phase::rates: return "rates";
    case Phase::end: return "end";
    case Phase::observe: return "observe";
  }
  return "";
}

std::string advance_text(const FieldDeclaration& field) {
  switch (field.advance) {
    case Advance::never: return "";
    case Advance::midpoint: return "advanced with " + field.rate;
    case Advance::predicted: return "predicted and corrected with " + field.rate;
    case Advance::by_passes: return "advanced by passes of its plugin";
  }
  return "";
}

std::string form_text(const Quantity& quantity) {
  if (quantity.columns == 0) return "one number";
  return fmt::format("{}rows of {} number{}", quantity.varying ? "a changing number of " : "", quantity.columns,
                     quantity.columns == 1 ? "" : "s");
}

}  // namespace mesogen::app
