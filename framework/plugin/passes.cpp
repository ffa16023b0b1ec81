#include "mesogen/plugin/passes.hpp"

#include <algorithm>
#include <utility>

namespace mesogen {

namespace {

// Passes that share a loop name the same fields.
void append(std::vector<std::string>& list, std::initializer_list<std::string_view> fields) {
  for (const auto field : fields)
    if (std::ranges::find(list, field) == list.end()) list.emplace_back(field);
}

}  // namespace

FieldDeclaration& FieldDeclaration::unit(std::string_view text) {
  unit_text = text;
  return *this;
}

FieldDeclaration& FieldDeclaration::doc(std::string_view text) {
  doc_text = text;
  return *this;
}

FieldDeclaration& FieldDeclaration::advanced_by(std::string_view rate_field) {
  advance = Advance::midpoint;
  rate = rate_field;
  return *this;
}

FieldDeclaration& FieldDeclaration::predicted_by(std::string_view rate_field) {
  advance = Advance::predicted;
  rate = rate_field;
  return *this;
}

FieldDeclaration& FieldDeclaration::advanced_by_passes() {
  advance = Advance::by_passes;
  return *this;
}

Pass& Pass::reads(std::initializer_list<std::string_view> fields) {
  append(own_reads, fields);
  return *this;
}

Pass& Pass::reads_neighbours(std::initializer_list<std::string_view> fields) {
  append(neighbour_reads, fields);
  return *this;
}

Pass& Pass::reads_if_present(std::initializer_list<std::string_view> fields) {
  append(optional_reads, fields);
  return *this;
}

Pass& Pass::writes(std::initializer_list<std::string_view> fields) {
  append(write_list, fields);
  return *this;
}

Pass& Pass::accumulates(std::initializer_list<std::string_view> fields) {
  append(accumulate_list, fields);
  return *this;
}

Pass& Pass::idle_if(bool idle) {
  adds_nothing = idle;
  return *this;
}

Pass& Pass::beside_pair_sums() {
  beside_sums = true;
  return *this;
}

Pass& Pass::advances_what_is_kept() {
  at_every_step = true;
  return *this;
}

Pass& Pass::conserves_momentum() {
  no_net_force = true;
  return *this;
}

Pass& Pass::run(std::function<void(const PassContext&)> function) {
  body = std::move(function);
  return *this;
}

FieldDeclaration& PassList::field(std::string_view name, Rank rank) {
  FieldDeclaration& field = fields_.emplace_back();
  field.name = name;
  field.rank = rank;
  return field;
}

Pass& PassList::pass(std::string_view name, Phase phase) {
  Pass& pass = passes_.emplace_back();
  pass.name = name;
  pass.phase = phase;
  return pass;
}

LinearTerm& PassList::diffusion(std::string_view field, std::string_view rate, double coefficient, StepCause cause,
                                std::string_view rule) {
  return linear_terms_.emplace_back(LinearTerm{LinearTerm::Kind::diffusion, std::string(field), std::string(rate),
                                               coefficient, cause, std::string(rule)});
}

LinearTerm& PassList::damping(std::string_view field, std::string_view rate, double coefficient, StepCause cause,
                              std::string_view rule) {
  return linear_terms_.emplace_back(LinearTerm{LinearTerm::Kind::damping, std::string(field), std::string(rate),
                                               coefficient, cause, std::string(rule)});
}

}  // namespace mesogen
