#include "schedule/catalogue.hpp"

#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "schedule/derived_name.hpp"

namespace mesogen {

void Catalogue::add(const FieldDeclaration& declaration, const std::string& owner) {
  const auto at = entries_.find(declaration.name);
  if (at == entries_.end()) {
    entries_.emplace(declaration.name, Entry{declaration, owner});
    return;
  }
  if (!at->second.initial)
    throw Error(ExitCode::bad_case, "field '" + declaration.name + "' is introduced by both " + at->second.owner +
                                        " and " + owner + ": remove one of them from the case");
  at->second.declaration = declaration;
  at->second.owner = owner;
}

void Catalogue::add_initial(const FieldDeclaration& declaration, const std::string& owner) {
  const std::string& name = declaration.name;
  const auto at = entries_.find(name);
  if (at == entries_.end()) {
    entries_.emplace(name, Entry{declaration, owner, true, owner});
    return;
  }
  Entry& entry = at->second;
  if (entry.initial)
    throw Error(ExitCode::bad_case,
                "field '" + name + "' is set by [" + entry.set_by + "]" +
                    (entry.set_by == owner ? " twice" : " and by [" + owner + "]: remove one of the two sections"));
  if (entry.declaration.rank != declaration.rank)
    throw Error(ExitCode::bad_case, "field '" + name + "' is a " + std::string(to_string(entry.declaration.rank)) +
                                        " of " + entry.owner + ", but [" + owner + "] sets a " +
                                        std::string(to_string(declaration.rank)));
  entry.initial = true;
  entry.set_by = owner;
}

void Catalogue::add_prescribed(const FieldDeclaration& declaration, const std::string& owner,
                               std::vector<std::string> sources) {
  add(declaration, owner);
  Entry& entry = entries_.find(declaration.name)->second;
  entry.prescribed = true;
  entry.sources = std::move(sources);
}

const Catalogue::Entry* Catalogue::find(std::string_view field) const {
  const auto at = entries_.find(field);
  return at == entries_.end() ? nullptr : &at->second;
}

int Catalogue::components(std::string_view field) const {
  if (const Entry* entry = find(field)) return component_count(entry->declaration.rank, dimension_);
  const DerivedName derived = derived_name(field);
  switch (derived.kind) {
    case DerivedName::Kind::none: return 0;
    case DerivedName::Kind::volume: return 1;
    case DerivedName::Kind::correction: return dimension_ * dimension_;
    case DerivedName::Kind::gradient: return components(derived.source) * dimension_;
    case DerivedName::Kind::laplacian: return components(derived.source);
  }
  return 0;
}

std::optional<Rank> Catalogue::rank(std::string_view field) const {
  if (const Entry* entry = find(field)) return entry->declaration.rank;
  const DerivedName derived = derived_name(field);
  switch (derived.kind) {
    case DerivedName::Kind::none: return {};
    case DerivedName::Kind::volume: return Rank::scalar;
    case DerivedName::Kind::correction: return Rank::matrix;
    case DerivedName::Kind::laplacian: return rank(derived.source);
    case DerivedName::Kind::gradient: {
      const auto of = rank(derived.source);
      if (of == Rank::scalar) return Rank::vector;
      if (of == Rank::vector) return Rank::matrix;
      return {};
    }
  }
  return {};
}

std::optional<FieldKind> Catalogue::kind(std::string_view field, std::string_view velocity) const {
  const std::optional<Rank> of = rank(field);
  if (!of) return {};
  const FieldRole role = field == velocity      ? FieldRole::velocity
                         : outlasts_step(field) ? FieldRole::state
                                                : FieldRole::derived;
  return FieldKind{*of, role, dimension_};
}

bool Catalogue::exists(std::string_view field) const { return components(field) > 0; }

std::string Catalogue::unit(std::string_view field) const {
  if (const Entry* entry = find(field)) return entry->declaration.unit_text;
  const DerivedName derived = derived_name(field);
  const auto per = [&](const std::string& length) {
    const std::string of = unit(derived.source);
    return of == "1" ? "1/" + length : "(" + of + ")/" + length;
  };
  switch (derived.kind) {
    case DerivedName::Kind::volume: return "m" + std::to_string(dimension_);
    case DerivedName::Kind::gradient: return per("m");
    case DerivedName::Kind::laplacian: return per("m2");
    default: return "1";
  }
}

bool Catalogue::is_state(std::string_view field) const {
  const Entry* entry = find(field);
  if (entry == nullptr || entry->declaration.advance == Advance::by_passes) return false;
  return entry->initial || entry->declaration.advance != Advance::never;
}

bool Catalogue::outlasts_step(std::string_view field) const {
  const Entry* entry = find(field);
  return is_state(field) || (entry != nullptr && entry->declaration.advance == Advance::by_passes);
}

std::vector<std::string> Catalogue::names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

}  // namespace mesogen
