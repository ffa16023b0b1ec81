// Setting a case up, last part: fields, passes and readers. See SetupBuilder.

#include "run/setup.hpp"

#include <algorithm>
#include <stdexcept>

#include "plugin/plugin_call.hpp"
#include "plugin/sample_scene.hpp"
#include "run/refusals.hpp"
#include "run/setup_builder.hpp"
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

}  // namespace

void SetupBuilder::collect_fields() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      for (const FieldDeclaration& field : member.passes.fields()) setup_.catalogue.add(field, member.instance);
    });
  collect_initial_fields();
  if (additions_.fields) additions_.fields(setup_);
  if (initial_missing_) return;
  for (const auto& [name, entry] : setup_.catalogue.all())
    if (entry.declaration.needs_start && !entry.initial)
      problems_.add({source_.file, 0, 0}, name,
                    "this field of " + entry.owner + " needs an initial condition: add a section that sets it" +
                        those_who_set(name, registry_, source_.dimension()));
}

void SetupBuilder::collect_initial_fields() {
  for (std::size_t n = 0; n < setup_.initial.size(); ++n)
    attempt(source_.initial[n], [&] {
      const auto& member = setup_.initial[n];
      for (const FieldDeclaration& field : member.plan.fields()) {
        refuse_made_by_framework(field.name, member.name);
        setup_.catalogue.add_initial(field, member.name);
      }
    });
}

// Unless the case names others: what the plugins show, those of the physics first.
void SetupBuilder::choose_shown_fields() {
  const auto show = [&](const auto& fields) {
    for (const FieldDeclaration& field : fields)
      if (field.is_shown && std::ranges::find(setup_.output_fields, field.name) == setup_.output_fields.end())
        setup_.output_fields.push_back(field.name);
  };
  for (const auto& member : setup_.physics) show(member.passes.fields());
  for (const auto& member : setup_.initial) show(member.plan.fields());
}

void SetupBuilder::choose_output() {
  if (!source_.output.fields_given) choose_shown_fields();
  for (const std::string& field : source_.output.fields) {
    if (field == "position") continue;
    if (setup_.catalogue.exists(field)) {
      setup_.output_fields.push_back(field);
    } else {
      std::string text = "there is no field '" + field + "' in this scene";
      if (const std::string near = nearest(field, setup_.catalogue.names()); !near.empty())
        text += "; did you mean '" + near + "'";
      std::string all;
      for (const std::string& name : setup_.catalogue.names()) all += (all.empty() ? "" : ", ") + name;
      problems_.add(source_.place("output.fields"), "output.fields",
                    text + ". There are: position, " + all + ", and X_gradient and X_laplacian of each X");
    }
  }
  resolved_.set_output_fields(setup_.output_fields);
}

void SetupBuilder::plan_observers() {
  for (std::size_t n = 0; n < setup_.observers.size(); ++n)
    attempt(source_.observers[n], [&] {
      auto& member = setup_.observers[n];
      call_plugin(member.type, "plan()", [&] { member.plugin->plan(setup_.scene, member.plan); });
      member.fields = member.plan.read_list();
      for (const std::string& field : member.plan.optional_list())
        if (setup_.catalogue.exists(field)) member.fields.push_back(field);
    });
}

// With wrong parameters plugins may not know what they would declare; if all of them do, the names of output fields
// can be checked too, so that a user sees all mistakes at once.
void SetupBuilder::check_fields_of_unsound_case() {
  try {
    for (auto& member : setup_.physics)
      member.passes = sample_declaration(*member.plugin, member.type, registry_, source_.dimension());
  } catch (const Error&) {
    return;
  }
  collect_fields();
  choose_output();
}

void SetupBuilder::put_together() {
  const bool all_made = setup_.physics.size() == source_.physics.size() &&
                        setup_.observers.size() == source_.observers.size() &&
                        setup_.initial.size() == source_.initial.size();
  const bool sound = problems_.empty();
  if (!all_made || source_.tree == nullptr) return;
  if (!sound) return check_fields_of_unsound_case();
  describe_scene();
  if (!problems_.empty()) return check_fields_of_unsound_case();
  declare_physics();
  if (!problems_.empty()) return check_fields_of_unsound_case();
  collect_fields();
  choose_output();
  if (!problems_.empty()) return;
  limit_step();
  plan_observers();
  refuse_traces(setup_, problems_);
  if (!problems_.empty()) return;
  if (additions_.readers) additions_.readers(setup_);
  std::vector<StepGraph::Member> members;
  for (const auto& member : setup_.physics)
    members.push_back({member.instance, &member.passes, member.type, member.on_device});
  std::vector<Reader> readers;
  for (const auto& member : setup_.observers) readers.push_back({"observers." + member.instance, member.fields});
  readers.push_back({"output.fields", setup_.output_fields});
  setup_.graph = std::make_unique<StepGraph>(setup_.catalogue, members, readers, *setup_.backend);
  refuse_few_neighbours(setup_, problems_);
  setup_.resolved_text = resolved_.text();
}

std::unique_ptr<Setup> set_up(Case source, const PluginRegistry& registry, Problems& problems,
                              const SetupAdditions& additions) {
  auto setup = std::make_unique<Setup>(std::move(source));
  SetupBuilder builder(*setup, registry, problems, additions);
  builder.choose_backend();
  builder.make_plugins();
  builder.choose_kernel();
  try {
    builder.put_together();
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_case) throw;
    problems.add_lines({setup->source.file, 0, 0}, error.what());
  }
  if (problems.empty() && !setup->graph) throw std::logic_error("a case without problems could not be set up");
  if (!problems.empty())
    throw Error(builder.refused() ? ExitCode::plugin_refused : ExitCode::bad_case, problems.text());
  return setup;
}

}  // namespace mesogen
