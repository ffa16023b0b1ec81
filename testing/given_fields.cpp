#include "given_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "plugin/plugin_call.hpp"
#include "plugin/sample_scene.hpp"
#include "schedule/derived_name.hpp"

namespace mesogen::testing {

namespace {

constexpr const char* owner = "the test";

bool contains(const std::vector<std::string>& list, const std::string& what) {
  return std::ranges::find(list, what) != list.end();
}

bool anyone_makes(const Setup& setup, const std::string& field) {
  return std::ranges::any_of(setup.physics, [&](const auto& member) {
    if (std::ranges::any_of(member.passes.linear_terms(),
                            [&](const auto& term) { return term.coefficient > 0.0 && term.rate == field; }))
      return true;
    return std::ranges::any_of(member.passes.passes(), [&](const Pass& pass) {
      return contains(pass.write_list, field) || contains(pass.accumulate_list, field);
    });
  });
}

/// The field that somebody must bring so that `field` can be derived from it; itself if it is not derived.
std::string root(const std::string& field) {
  const DerivedName derived = derived_name(field);
  if (derived.kind == DerivedName::Kind::none) return field;
  return derived.source.empty() ? std::string() : root(derived.source);
}

Rank rank_of(int components, int dimension) {
  for (const Rank rank : {Rank::scalar, Rank::vector, Rank::matrix})
    if (components == component_count(rank, dimension)) return rank;
  throw Error(ExitCode::bad_case, fmt::format("no field has {} components: 1, {} or {}", components, dimension,
                                              component_count(Rank::matrix, dimension)));
}

FieldDeclaration declaration(const std::string& name, Rank rank, const std::string& unit) {
  FieldDeclaration field;
  field.name = name;
  field.rank = rank;
  field.unit_text = unit;
  field.doc_text = "given by the test";
  return field;
}

}  // namespace

SetupAdditions SceneCompletion::additions() {
  SetupAdditions all;
  all.scene = [this](Scene& scene) {
    for (const auto& [name, value] : constants_) scene.constants.emplace(name, value);
  };
  all.fields = [this](Setup& setup) {
    add_given(setup);
    add_missing(setup);
  };
  all.readers = [this](Setup& setup) {
    for (const auto& member : setup.observers)
      for (const std::string& field :
           member.plan.fields([&](const std::string& name) { return setup.catalogue.exists(name); }))
        add_missing(setup, field, false, "observers." + member.instance);
    keep_all(setup);
  };
  return all;
}

// A field that a plugin makes keeps its declaration: the test only says with what it starts.
void SceneCompletion::add_given(Setup& setup) const {
  const int dimension = setup.source.dimension();
  for (const auto& [name, given] : given_) {
    if (given.value && root(name).empty())
      throw Error(ExitCode::bad_case,
                  fmt::format("the field '{}' follows from the positions of the particles: it cannot be given", name));
    if (setup.catalogue.find(name) != nullptr) continue;
    FieldDeclaration field = known(given.value ? name : root(name), dimension);
    if (field.name.empty() && !given.value) continue;
    if (given.value && (field.name.empty() || component_count(field.rank, dimension) != given.components))
      field = declaration(name, rank_of(given.components, dimension), "1");
    if (setup.catalogue.find(field.name) != nullptr) continue;
    if (anyone_makes(setup, field.name)) {
      setup.catalogue.add(field, owner);
    } else {
      setup.catalogue.add_initial(field, owner);
    }
  }
}

void SceneCompletion::add_missing(Setup& setup) const {
  for (const auto& member : setup.physics) {
    for (const LinearTerm& term : member.passes.linear_terms()) {
      if (!(term.coefficient > 0.0)) continue;
      const std::string by = member.instance + ": linear terms of " + term.field;
      add_missing(setup, term.field, false, by);
      if (!term.divisor.empty()) add_missing(setup, term.divisor, false, by);
      add_missing(setup, term.rate, true, by);
    }
    for (const Pass& pass : member.passes.passes()) {
      const std::string by = member.instance + ": " + pass.name;
      for (const auto* const list : {&pass.own_reads, &pass.neighbour_reads})
        for (const std::string& field : *list) add_missing(setup, field, false, by);
      for (const std::string& field : pass.accumulate_list) add_missing(setup, field, true, by);
    }
  }
  // What a case must set at the start is here a field like others.
  std::vector<FieldDeclaration> to_set;
  for (const auto& [name, entry] : setup.catalogue.all())
    if (entry.declaration.needs_start && !entry.initial) to_set.push_back(entry.declaration);
  for (const FieldDeclaration& field : to_set) setup.catalogue.add_initial(field, owner);
}

void SceneCompletion::add_missing(Setup& setup, const std::string& wanted, bool written, const std::string& by) const {
  if (setup.catalogue.exists(wanted)) return;
  const std::string field = root(wanted);
  if (field.empty() || setup.catalogue.exists(field)) return;
  const FieldDeclaration found = known(field, setup.source.dimension());
  if (field == "position")
    throw Error(ExitCode::bad_case,
                fmt::format("'{}' reads 'position', which is no field: take coordinates from context.position(axis), "
                            "without naming them",
                            by));
  if (found.name.empty())
    throw Error(
        ExitCode::bad_case,
        fmt::format("'{}' {} '{}', which no plugin that can be found introduces: give it with set(\"{}\", ...), "
                    "or spell it right",
                    by, written ? "adds to" : "reads", wanted, field));
  if (written || anyone_makes(setup, field)) {
    setup.catalogue.add(found, owner);
  } else {
    setup.catalogue.add_initial(found, owner);
  }
}

void SceneCompletion::keep_all(Setup& setup) {
  std::set<std::string> kept{"volume", "correction"};
  for (const auto& [name, entry] : setup.catalogue.all()) {
    const bool state = setup.catalogue.is_state(name);
    if (!state && !anyone_makes(setup, name)) continue;
    kept.insert(name);
    if (state) kept.insert({name + "_gradient", name + "_laplacian"});
  }
  setup.output_fields.assign(kept.begin(), kept.end());
}

/// What the plugins that can be found say of a field; no name if none knows it.
FieldDeclaration SceneCompletion::known(const std::string& field, int dimension) const {
  for (const std::string& name : registry_.names(PluginKind::initial)) {
    if (!usable_dimensions(*registry_.find(PluginKind::initial, name)->descriptor).contains(dimension)) continue;
    InitialPlan plan;
    const auto initial = registry_.make_initial(name, dimension);
    call_plugin(name, "plan()", [&] { initial->plan(plan); });
    for (const FieldDeclaration& declared : plan.fields())
      if (declared.name == field) return declaration(field, declared.rank, declared.unit_text);
  }
  for (const std::string& name : registry_.names(PluginKind::physics)) {
    if (!usable_dimensions(*registry_.find(PluginKind::physics, name)->descriptor).contains(dimension)) continue;
    const auto physics = registry_.make_physics(name, Precision::double_precision, dimension);
    ParameterList parameters;
    call_plugin(name, "parameters()", [&] { physics->parameters(parameters); });
    const PassList list = sample_declaration(*physics, name, registry_, dimension);
    for (const FieldDeclaration& declared : list.fields())
      if (declared.name == field) return declaration(field, declared.rank, declared.unit_text);
  }
  return {};
}

}  // namespace mesogen::testing
