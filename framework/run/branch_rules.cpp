#include "run/branch_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "case/toml_reader.hpp"
#include "case/toml_text.hpp"
#include "case/value.hpp"
#include "run/planned_fields.hpp"
#include "text/rounded_text.hpp"
#include "time/marks.hpp"

namespace mesogen {

namespace {

struct Fixed {
  std::string section;
  std::set<std::string> keys;  ///< of the section; empty: all
  std::string why;
};

std::vector<Fixed> fixed_sections(const Case& before, const Case& after) {
  std::vector<Fixed> all = {
      {"domain", {"size"}, "is that of the particles in the checkpoint"},
      {"particles", {}, "is about how a box is filled, and a branch goes on with the particles of the checkpoint"},
  };
  std::set<std::string> initial;
  for (const auto* const source : {&before, &after})
    for (const auto& choice : source->initial) initial.insert(choice.type);
  for (const std::string& section : initial)
    all.push_back({section,
                   {},
                   "has an effect only at the start of a run, and a branch goes on with what the particles of the "
                   "checkpoint carry"});
  return all;
}

/// Of [solids.NAME] what holds at the surface may change, but not where it is.
const std::set<std::string> changeable_of_solids{"velocity", "angular_velocity",   "slip", "anchoring",
                                                 "angle",    "anchoring_strength", "order"};

std::set<std::string> keys_of(const Value* section) {
  std::set<std::string> keys;
  const auto* const table = section == nullptr ? nullptr : section->as<Value::Table>();
  if (table != nullptr)
    for (const Entry& entry : *table) keys.insert(entry.key);
  return keys;
}

std::string text_at(const Value& tree, const std::string& path) {
  const Value* const value = tree.find_path(path);
  return value == nullptr ? std::string() : inline_text(*value);
}

/// The field that a name of the checkpoint is about: "temperature" of "field temperature 0".
std::set<std::string> fields_of(const Checkpoint& checkpoint) {
  constexpr std::string_view prefix = "field ";
  std::set<std::string> fields;
  for (const auto& [name, values] : checkpoint.numbers)
    if (name.starts_with(prefix)) fields.insert(name.substr(prefix.size(), name.rfind(' ') - prefix.size()));
  return fields;
}

void check_fields(const Setup& after, const Checkpoint& checkpoint, Problems& problems) {
  const std::set<std::string> stored = fields_of(checkpoint);
  const auto list = checkpointed_fields(after);
  const std::set<std::string> needed(list.begin(), list.end());
  const auto complain = [&](const std::set<std::string>& from, const std::set<std::string>& in, const char* text) {
    std::set<std::string> missing;
    std::ranges::set_difference(from, in, std::inserter(missing, missing.end()));
    if (missing.empty()) return;
    problems.add({after.source.file, 0, 0}, "physics",
                 fmt::format("a branch has the fields that the run advances, no more and no fewer, but {} {}",
                             fmt::join(missing, ", "), text));
  };
  complain(needed, stored, "would be new: leave out the plugins that bring them");
  complain(stored, needed, "would have no plugin that advances them: keep the plugins that do");
}

void check_numbers(const Setup& after, const Checkpoint& checkpoint, Problems& problems) {
  for (const auto& member : after.physics)
    for (const auto& kept : member.passes.kept()) {
      const auto at = checkpoint.numbers.find(member.instance + " keeps " + kept.name);
      const std::size_t there = at == checkpoint.numbers.end() ? 0 : at->second.size();
      if (there == kept.count) continue;
      problems.add(
          after.source.place(member.instance), member.instance,
          fmt::format("goes on from {} numbers (\"{}\") and the checkpoint has {}: keep the plugin, its name and "
                      "its resolution as they were",
                      kept.count, kept.name, there));
    }
}

}  // namespace

void check_branched_case(const Case& before, const Case& after, Problems& problems) {
  Problems none;
  const auto old_tree = parse_toml(before.resolved_text, before.file, none);
  const auto new_tree = parse_toml(after.resolved_text, after.file, none);
  for (const Fixed& fixed : fixed_sections(before, after)) {
    std::set<std::string> keys = fixed.keys;
    if (keys.empty()) {
      keys = keys_of(old_tree->find(fixed.section));
      keys.merge(keys_of(new_tree->find(fixed.section)));
    }
    for (const std::string& key : keys) {
      const std::string path = joined(fixed.section, key);
      if (text_at(*old_tree, path) == text_at(*new_tree, path)) continue;
      problems.add(after.place(path), path, "cannot change at a branch: it " + fixed.why);
    }
  }
  std::set<std::string> solids = keys_of(old_tree->find("solids"));
  solids.merge(keys_of(new_tree->find("solids")));
  for (const std::string& solid : solids) {
    std::set<std::string> keys = keys_of(old_tree->find_path(joined("solids", solid)));
    keys.merge(keys_of(new_tree->find_path(joined("solids", solid))));
    for (const std::string& key : keys) {
      const std::string path = joined(joined("solids", solid), key);
      if (changeable_of_solids.contains(key) || text_at(*old_tree, path) == text_at(*new_tree, path)) continue;
      problems.add(
          after.place(path), path,
          "cannot change at a branch: it says where the solid is, and a branch goes on with the particles that "
          "the checkpoint has around it");
    }
  }
}

void check_branched_setup(const Setup& before, const Setup& after, const Checkpoint& checkpoint, Problems& problems) {
  const Case& source = after.source;
  for (int axis = 0; axis < after.scene.dimension; ++axis)
    if (before.scene.periodic[axis] != after.scene.periodic[axis]) {
      problems.add(
          source.place("domain.boundary"), "domain.boundary",
          "cannot change from periodic faces to walls or back at a branch: the particles of the checkpoint are "
          "spread for the old faces");
      break;
    }
  check_fields(after, checkpoint, problems);
  check_numbers(after, checkpoint, problems);
  if (!(source.time.end > Arrival{checkpoint.time, checkpoint.step_size}.reaches()))
    problems.add(
        source.place("time.end"), "time.end",
        fmt::format("must be later than the branch, t = {}, but is {}: give a later end, such as --set time.end={}",
                    source.units.time_text(checkpoint.time), source.units.time_text(source.time.end),
                    rounded_text(2.0 * checkpoint.time)));
}

bool same_cells(const Setup& before, const Setup& after) {
  return before.scene.support == after.scene.support && before.source.boundary.type == after.source.boundary.type;
}

}  // namespace mesogen
