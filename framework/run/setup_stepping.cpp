#include <algorithm>
#include <cmath>

#include "plugin/plugin_call.hpp"
#include "run/setup_context.hpp"
#include "schedule/linear_terms.hpp"
#include "time/stages.hpp"
#include "time/step_control.hpp"

namespace mesogen {

namespace {

// Costs in explicit steps of the same scene: of a Laplacian of one component in one stage, and of all else in a
// stabilised step. Measured, but not during the run: every run chooses alike.
constexpr double laplacian_cost = 0.05;
constexpr double other_cost = 2.0;
// Stabilised steps must cost at most so much of explicit ones, which cannot have too few stages.
constexpr double worthwhile = 0.8;

void declare(SetupContext& context, bool stabilised) {
  Setup& setup = context.setup;
  setup.scene.stabilised_steps = stabilised;
  for (std::size_t n = 0; n < setup.physics.size(); ++n)
    context.attempt(setup.source.physics[n], [&] {
      auto& member = setup.physics[n];
      member.passes = {};
      call_plugin(member.type, "declare()", [&] { member.plugin->declare(setup.scene, member.passes); });
    });
  for (const auto& member : setup.physics)
    for (const auto& [name, value] : member.passes.constants()) setup.scene.constants[name] = value;
}

/// The linear terms that stages can take, with the number of components of their fields. None where the velocity of a
/// flow is not among these fields: what a stabilised step does goes by the velocity.
std::vector<std::pair<LinearTerms, int>> find_staged(const Setup& setup) {
  Catalogue catalogue(setup.scene.dimension);
  std::vector<LinearTerms> all;
  for (const auto& member : setup.physics) {
    add_linear_terms(member.instance, member.passes, all);
    for (const FieldDeclaration& field : member.passes.fields())
      if (catalogue.find(field.name) == nullptr) catalogue.add(field, member.instance);
  }
  std::vector<std::pair<LinearTerms, int>> staged;
  for (const LinearTerms& terms : all)
    if (can_be_staged(terms, catalogue)) staged.emplace_back(terms, catalogue.components(terms.field));
  for (const auto& member : setup.physics) {
    const std::string& velocity = member.passes.transport().velocity;
    const auto is_velocity = [&](const auto& one) { return one.first.field == velocity; };
    if (!velocity.empty() && std::ranges::none_of(staged, is_velocity)) return {};
  }
  return staged;
}

/// The longest step of the scene as it was declared last, s; infinite if nothing limits it.
double longest_step(const Setup& setup) {
  StepLimits limits;
  for (const auto& member : setup.physics) add_step_limits(member, setup, limits);
  const StepControl control(setup.scene, limits, {}, setup.source.time.factor);
  return control.choose(setup.scene.expected_speed(), 0.0).seconds;
}

/// Of a stabilised step, in explicit ones.
double cost_of_step(const Setup& setup, double step_size) {
  double laplacians = 0.0;
  for (const auto& [terms, components] : find_staged(setup))
    if (terms.diffusion.any())
      laplacians += components * stages_needed(largest_rate(terms, largest_laplacian(setup)), step_size);
  return other_cost + laplacian_cost * laplacians;
}

/// With the scene declared for stabilised steps.
bool pays(const Setup& setup, double longest_explicit) {
  const double longest = longest_step(setup);
  if (!std::isfinite(longest_explicit) || !std::isfinite(longest)) return false;
  // A given step is taken as it is. Explicit ones are stable a little beyond their limit.
  if (const auto given = setup.source.time.step) return *given > 2.0 * longest_explicit && *given <= longest;
  // The end of the run must not count: a run that is extended goes on as it began.
  return cost_of_step(setup, longest) / longest < worthwhile / longest_explicit;
}

}  // namespace

void declare_physics(SetupContext& context) {
  Setup& setup = context.setup;
  const auto& time = setup.source.time;
  const auto refuse = [&](const std::string& why) {
    context.problems.add(setup.source.place("time.stepping"), "time.stepping", why);
  };
  const bool wanted = time.stepping == "stabilised";
  if (wanted && time.scheme != "midpoint")
    return refuse(
        "stabilised steps have a scheme of their own: leave time.scheme at \"midpoint\", or take \"explicit\"");
  declare(context, wanted);
  if (!context.problems.empty() || time.stepping == "explicit" || time.scheme != "midpoint") return;
  try {
    if (find_staged(setup).empty()) {
      if (wanted)
        refuse(
            "stages are for viscosity, elasticity, friction and other linear terms that plugins declare, and the flow "
            "of this case has none: leave it at \"auto\"");
      return;
    }
    if (wanted) return;
    const double longest_explicit = longest_step(setup);
    const Problems none = context.problems;
    declare(context, true);
    if (context.problems.empty() && pays(setup, longest_explicit)) return;
    context.problems = none;
    declare(context, false);
  } catch (const Error&) {
    // What is wrong with a limit or a term is told, with its place, where they are collected.
    if (!wanted) declare(context, false);
  }
}

}  // namespace mesogen
