// Setting a case up, last part: fields, passes and readers. See SetupBuilder.

#include "simulation/setup.hpp"

#include <stdexcept>

#include "case/nearest.hpp"
#include "plugin/plugin_call.hpp"
#include "simulation/refusals.hpp"
#include "simulation/setup_builder.hpp"

namespace mesogen {

void SetupBuilder::collect_fields() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      auto& member = setup_.physics[n];
      call_plugin(member.type, "passes()", [&] { member.plugin->passes(member.passes); });
      for (const FieldDeclaration& field : member.passes.fields()) setup_.catalogue.add(field, member.instance);
    });
  const auto initial = [&](const std::string& name, Rank rank, const std::string& unit, const std::string& owner) {
    FieldDeclaration field;
    field.name = name;
    field.rank = rank;
    field.unit_text = unit;
    field.doc_text = "as the initial conditions set it";
    setup_.catalogue.add_initial(field, owner);
  };
  if (source_.director.given) initial("order_tensor", Rank::order_tensor, "1", "director");
  if (source_.velocity.given) initial("velocity", Rank::vector, "m/s", "velocity");
  if (source_.colour.given) initial("colour", Rank::scalar, "1", "colour");
  if (additions_.fields) additions_.fields(setup_);
  const auto* const order_tensor = setup_.catalogue.find("order_tensor");
  if (order_tensor != nullptr && !order_tensor->initial)
    problems_.add({source_.file, 0, 0}, "director",
                  "this scene has an order tensor: say how it starts, such as [director] with type = \"perturbed\"");
}

void SetupBuilder::choose_output() {
  for (const std::string& field : source_.output.fields) {
    if (field == "position") continue;
    if (setup_.catalogue.exists(field)) {
      setup_.output_fields.push_back(field);
    } else if (source_.output.fields_given) {
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

void SetupBuilder::put_together() {
  // Fields depend on which plugins there are, the rest on sound parameters too.
  const bool all_made =
      setup_.physics.size() == source_.physics.size() && setup_.observers.size() == source_.observers.size();
  const bool sound = problems_.empty();
  if (!all_made || source_.tree == nullptr) return;
  if (sound) describe_scene();
  collect_fields();
  choose_output();
  if (!sound) return;
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
  builder.place_defects();
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
