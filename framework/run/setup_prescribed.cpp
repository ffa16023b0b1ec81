#include <algorithm>
#include <set>

#include "case/toml_text.hpp"
#include "plugin/sample_scene.hpp"
#include "prescribed/sampling.hpp"
#include "run/setup_context.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

std::vector<double> field_at_start(SetupContext& context, const std::string& field) {
  const Setup& setup = context.setup;
  std::vector<double> start;
  for (std::size_t n = 0; n < setup.initial.size(); ++n)
    context.attempt(setup.source.initial[n], [&] {
      const Setup::InitialMember& member = setup.initial[n];
      for (const FieldDeclaration& declared : member.plan.fields()) {
        if (declared.name != field) continue;
        InitialState state = initial_state(member, setup);
        const auto values = state.component(field, 0);
        start.assign(values.begin(), values.end());
      }
    });
  return start;
}

/// Scalars that last from step to step: those that physics advances or initial conditions set.
std::vector<std::string> scalar_states(SetupContext& context) {
  const Setup& setup = context.setup;
  std::set<std::string> names;
  const auto collect = [&](const auto& fields, bool set) {
    for (const FieldDeclaration& field : fields)
      if (field.rank == Rank::scalar && (set || field.advance != Advance::never)) names.insert(field.name);
  };
  for (const auto& member : setup.initial) collect(member.plan.fields(), true);
  for (const auto& member : setup.physics) {
    // What it finds wrong is told when the scene is complete.
    try {
      const PassList list = sample_declaration(*member.plugin, member.type, context.registry, setup.scene.dimension);
      collect(list.fields(), false);
    } catch (const Error&) {
      continue;
    }
  }
  return {names.begin(), names.end()};
}

Vocabulary vocabulary(SetupContext& context) {
  Vocabulary words = vocabulary_of(context.setup.scene);
  words.fields = scalar_states(context);
  // A constant that varies is none.
  for (const Prescribed& one : context.prescribed) {
    words.constants.erase(one.field());
    words.refused[one.field()] = "is prescribed itself, by " + full_key(one) + ": an expression takes constants";
  }
  return words;
}

// Two numbers of one name would become one field.
void refuse_two_of_a_name(const SetupContext& context, const Prescribed& one, Problems& problems) {
  for (const std::string& other : context.may_vary.at(one.field()))
    if (other != full_key(one))
      problems.add(value_of(one, 0).place, full_key(one),
                   "varies, and " + other + " is about the same field, '" + one.field() +
                       "': put all of it into one of the two sections, and remove the other");
}

/// The number, or list of numbers, of an expression that is the same everywhere.
std::vector<double> constant_numbers(const Prescribed& prescribed, Problems& problems) {
  std::vector<double> numbers;
  for (std::size_t n = 0; n < prescribed.components.size(); ++n) {
    numbers.push_back(prescribed.components[n].number());
    const std::string wrong = what_is_wrong(prescribed, numbers.back());
    const Value& given = value_of(prescribed, n);
    if (!wrong.empty())
      problems.add(given.place, full_key(prescribed),
                   shown(given) + " " + wrong + ", but is " + rounded_text(numbers.back()));
  }
  return numbers;
}

}  // namespace

void find_prescribed(SetupContext& context, Problems& problems) {
  Setup& setup = context.setup;
  const Vocabulary words = vocabulary(context);
  setup.prescribed.clear();
  setup.scene.varying.clear();
  for (Prescribed& one : context.prescribed) {
    make_programs(one, words, problems);
    if (!problems.empty()) continue;
    if (one.constant()) {
      one.largest = constant_numbers(one, problems);
    } else {
      refuse_two_of_a_name(context, one, problems);
      one.largest = largest_values(
          one, setup.scene, setup.arrangement, setup.source.time.end,
          [&](const std::string& field) { return field_at_start(context, field); }, problems);
      setup.scene.varying.insert(one.field());
      setup.prescribed.push_back(one);
    }
    set_numbers(one);
  }
}

namespace {

// A case that stores what may vary gets it also where it does not.
void add_wanted_numbers(SetupContext& context) {
  Setup& setup = context.setup;
  const auto add = [&](const Prescribed& one) {
    if (!setup.scene.varying.contains(one.field()) &&
        std::ranges::find(setup.source.output.fields, one.field()) != setup.source.output.fields.end())
      setup.prescribed.push_back(one);
  };
  for (const Prescribed& one : context.prescribed) add(one);
  for (Prescribed& one : context.numbers) {
    take_numbers(one);
    add(one);
  }
}

}  // namespace

void collect_prescribed_fields(SetupContext& context) {
  Setup& setup = context.setup;
  if (context.problems.empty()) add_wanted_numbers(context);
  const auto add = [&](const Prescribed& one, const std::string& name, Rank rank, const std::string& unit,
                       const std::string& doc, std::optional<FieldBounds> bounds) {
    FieldDeclaration field;
    field.name = name;
    field.rank = rank;
    field.unit_text = unit;
    field.doc_text = doc;
    field.bounds = std::move(bounds);
    std::set<std::string> sources;
    for (const Program& program : one.components) sources.insert(program.fields.begin(), program.fields.end());
    setup.catalogue.add_prescribed(field, one.owner, {sources.begin(), sources.end()});
  };
  for (const Prescribed& one : setup.prescribed) {
    const Parameter& parameter = one.parameter;
    add(one, one.field(), one.rank(), parameter.unit_text, parameter.doc_text, bounds_of(one));
    if (one.has_gradient())
      add(one, one.field() + "_gradient", Rank::vector, "(" + parameter.unit_text + ")/m",
          "gradient of " + one.field() + ", by differences over a spacing to both sides", {});
  }
}

}  // namespace mesogen
