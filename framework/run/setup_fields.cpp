#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "plugin/plugin_call.hpp"
#include "run/setup_context.hpp"
#include "schedule/derived_name.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

/// ": [director]", the initial conditions that set a field; empty if there is none.
std::string those_who_set(const std::string& field, const PluginRegistry& registry, int dimension) {
  std::string text;
  for (const std::string& name : registry.names(PluginKind::initial)) {
    InitialPlan plan;
    try {
      const auto plugin = registry.make_initial(name, dimension);
      call_plugin(name, "plan()", [&] { plugin->plan(plan); });
    } catch (const Error&) {
      continue;  // what is wrong with another plugin is not asked here
    }
    for (const FieldDeclaration& declared : plan.fields())
      if (declared.name == field) text += (text.empty() ? ": [" : " or [") + name + "]";
  }
  return text;
}

void refuse_made_by_framework(const std::string& field, const std::string& initial) {
  if (field != "position" && derived_name(field).kind == DerivedName::Kind::none) return;
  throw Error(ExitCode::plugin_refused, "[" + initial + "] sets '" + field +
                                            "', which the framework makes: an initial condition sets fields that a "
                                            "plugin introduces");
}

void collect_initial_fields(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.initial.size(); ++n)
    context.attempt(source.initial[n], [&] {
      const auto& member = setup.initial[n];
      for (const FieldDeclaration& field : member.plan.fields()) {
        refuse_made_by_framework(field.name, member.name);
        setup.catalogue.add_initial(field, member.name);
      }
    });
}

// Unless the case names others: what the plugins show, those of the physics first.
void choose_shown_fields(SetupContext& context) {
  Setup& setup = context.setup;
  const auto show = [&](const auto& fields) {
    for (const FieldDeclaration& field : fields)
      if (field.is_shown && std::ranges::find(setup.output_fields, field.name) == setup.output_fields.end())
        setup.output_fields.push_back(field.name);
  };
  for (const auto& member : setup.physics) show(member.passes.fields());
  for (const auto& member : setup.initial) show(member.plan.fields());
}

}  // namespace

void collect_fields(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.physics.size(); ++n)
    context.attempt(source.physics[n], [&] {
      const auto& member = setup.physics[n];
      for (const FieldDeclaration& field : member.passes.fields()) setup.catalogue.add(field, member.instance);
    });
  collect_prescribed_fields(context);
  collect_initial_fields(context);
  if (context.additions.fields) context.additions.fields(setup);
  if (context.initial_missing) return;
  for (const auto& [name, entry] : setup.catalogue.all())
    if (entry.declaration.needs_start && !entry.initial)
      context.problems.add({source.file, 0, 0}, name,
                           "this field of " + entry.owner + " needs an initial condition: add a section that sets it" +
                               those_who_set(name, context.registry, source.dimension()));
}

void choose_output(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  if (!source.output.fields_given) choose_shown_fields(context);
  for (const std::string& field : source.output.fields) {
    if (field == "position") continue;
    if (setup.catalogue.exists(field)) {
      setup.output_fields.push_back(field);
    } else if (!context.may_vary.contains(field)) {  // of those a mistake is told by itself
      std::string text = "there is no field '" + field + "' in this scene";
      if (const std::string near = nearest(field, setup.catalogue.names()); !near.empty())
        text += "; did you mean '" + near + "'";
      const std::string all = fmt::format("{}", fmt::join(setup.catalogue.names(), ", "));
      context.problems.add(source.place("output.fields"), "output.fields",
                           text + ". There are: position, " + all + ", and X_gradient and X_laplacian of each X");
    }
  }
  context.resolved.set_output_fields(setup.output_fields);
}

}  // namespace mesogen
