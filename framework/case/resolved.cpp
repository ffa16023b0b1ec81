#include "case/resolved.hpp"

#include "case/framework_keys.hpp"
#include "case/parameter_value.hpp"
#include "case/toml_text.hpp"
#include "case/value.hpp"

namespace mesogen {

namespace {

void fill(Value& tree, const std::string& path, const ParameterList& list, const std::string& left_open = "") {
  for (const auto& parameter : list.all())
    if (auto value = current_value(parameter); value && parameter.name != left_open && list.applies(parameter))
      tree.set_path(joined(path, parameter.name), std::move(*value));
}

}  // namespace

// A file that cannot be read leaves a case without a tree; its problems are reported later, with those of its plugins.
ResolvedCase::ResolvedCase(const Case& source)
    : tree_(source.tree ? std::make_unique<Value>(*source.tree)
                        : std::make_unique<Value>(Value::Table{}, SourcePlace{source.file})) {
  Case copy = source;
  std::string precision = std::string(to_string(copy.run.precision));
  if (!copy.units.si()) fill(*tree_, "units", case_keys::units(copy.units));
  fill(*tree_, "domain", case_keys::domain(copy.domain));
  fill(*tree_, "particles", case_keys::particles(copy.particles));
  fill(*tree_, "kernel", case_keys::kernel(copy.smoothing_length_ratio, copy.laplacian));
  fill(*tree_, "time", case_keys::time(copy.time));
  fill(*tree_, "output", case_keys::output(copy.output), copy.output.fields_given ? "" : "fields");
  fill(*tree_, "run", case_keys::run(copy.run, precision));
}

ResolvedCase::~ResolvedCase() = default;

void ResolvedCase::add(const CaseSection& section, const ParameterList& list) {
  // a boundary given by its name alone becomes a table where it has keys
  if (const auto* const value = tree_->find_path(section.path());
      value != nullptr && value->as<std::string>() != nullptr) {
    if (list.all().empty()) return;
    tree_->set_path(section.path(), Value{Value::Table{{"type", value->place, *value}}, value->place});
  }
  fill(*tree_, section.path(), list);
}

void ResolvedCase::set_output_fields(const std::vector<std::string>& fields) {
  Value::List list;
  for (const auto& field : fields) list.push_back(Value{field, {}});
  tree_->set_path("output.fields", Value{std::move(list), {}});
}

std::string ResolvedCase::text() const { return document_text(*tree_); }

}  // namespace mesogen
