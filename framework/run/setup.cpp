#include "run/setup.hpp"

#include <stdexcept>

#include "plugin/plugin_call.hpp"
#include "plugin/sample_scene.hpp"
#include "run/choose_backend.hpp"
#include "run/refusals.hpp"
#include "run/setup_context.hpp"

namespace mesogen {

namespace {

void choose_backend(SetupContext& context) {
  Setup& setup = context.setup;
  BackendChoice choice = choose_backend(setup.source, context.registry);
  setup.backend = choice.backend;
  setup.why_on_host = std::move(choice.why_on_host);
  if (!choice.problem.empty()) context.problems.add(setup.source.place("run.device"), "run.device", choice.problem);
}

void plan_observers(SetupContext& context) {
  Setup& setup = context.setup;
  const Case& source = setup.source;
  for (std::size_t n = 0; n < setup.observers.size(); ++n)
    context.attempt(source.observers[n], [&] {
      auto& member = setup.observers[n];
      call_plugin(member.type, "plan()", [&] { member.plugin->plan(setup.scene, member.plan); });
      member.fields = member.plan.fields([&](const std::string& field) { return setup.catalogue.exists(field); });
    });
}

// With wrong parameters plugins may not know what they would declare; if all of them do, the names of output fields
// can be checked too, so that a user sees all mistakes at once.
void collect_fields_of_unsound_case(SetupContext& context) {
  try {
    for (auto& member : context.setup.physics)
      member.passes =
          sample_declaration(*member.plugin, member.type, context.registry, context.setup.source.dimension());
  } catch (const Error&) {
    return;
  }
  collect_fields(context);
  choose_output(context);
}

void order_step(SetupContext& context) {
  Setup& setup = context.setup;
  std::vector<StepGraph::Member> members;
  for (const auto& member : setup.physics)
    members.push_back({member.instance, &member.passes, member.type, member.on_device});
  std::vector<Reader> readers;
  for (const auto& member : setup.observers) readers.push_back({"observers." + member.instance, member.fields});
  readers.push_back({"output.fields", setup.output_fields});
  setup.graph =
      std::make_unique<StepGraph>(setup.catalogue, members, readers, *setup.backend, setup.scene.stabilised_steps);
}

bool all_made(const Setup& setup) {
  const Case& source = setup.source;
  return setup.physics.size() == source.physics.size() && setup.observers.size() == source.observers.size() &&
         setup.initial.size() == source.initial.size();
}

void put_together(SetupContext& context) {
  Setup& setup = context.setup;
  const auto sound = [&] { return context.problems.empty(); };
  if (!all_made(setup) || setup.source.tree == nullptr) return;
  if (sound()) describe_scene(context);
  if (sound()) declare_physics(context);
  if (!sound()) return collect_fields_of_unsound_case(context);
  collect_fields(context);
  choose_output(context);
  if (!sound()) return;
  limit_step(context);
  plan_observers(context);
  refuse_traces(setup, context.problems);
  if (!sound()) return;
  if (context.additions.readers) context.additions.readers(setup);
  order_step(context);
  refuse_few_neighbours(setup, context.problems);
  setup.resolved_text = context.resolved.text();
}

}  // namespace

std::unique_ptr<Setup> set_up(Case source, const PluginRegistry& registry, Problems& problems,
                              const SetupAdditions& additions) {
  auto setup = std::make_unique<Setup>(std::move(source));
  SetupContext context{*setup, registry, problems, additions, ResolvedCase(setup->source), {}, {}, {}};
  choose_backend(context);
  make_plugins(context);
  choose_kernel(context);
  try {
    put_together(context);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_case) throw;
    problems.add_lines({setup->source.file, 0, 0}, error.what());
  }
  if (problems.empty() && !setup->graph) throw std::logic_error("a case without problems could not be set up");
  if (!problems.empty()) throw Error(context.refused ? ExitCode::plugin_refused : ExitCode::bad_case, problems.text());
  return setup;
}

}  // namespace mesogen
