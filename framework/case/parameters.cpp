#include "mesogen/plugin/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/given_value.hpp"
#include "case/parameter_value.hpp"
#include "case/toml_text.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

/// "2", "3 or 4"
std::string sizes_text(const std::vector<std::size_t>& sizes) {
  std::string text;
  for (const auto size : sizes) text += (text.empty() ? "" : " or ") + std::to_string(size);
  return text;
}

}  // namespace

Parameter& Parameter::unit(std::string_view text) {
  unit_text = text;
  return *this;
}

Parameter& Parameter::doc(std::string_view text) {
  doc_text = text;
  return *this;
}

Parameter& Parameter::at_least(double bound) {
  lowest = bound;
  lowest_excluded = false;
  return *this;
}

Parameter& Parameter::above(double bound) {
  lowest = bound;
  lowest_excluded = true;
  return *this;
}

Parameter& Parameter::at_most(double bound) {
  highest = bound;
  highest_excluded = false;
  return *this;
}

Parameter& Parameter::below(double bound) {
  highest = bound;
  highest_excluded = true;
  return *this;
}

Parameter& Parameter::required() {
  is_required = true;
  return *this;
}

Parameter& Parameter::choices(std::vector<std::string> allowed) {
  choice_list = std::move(allowed);
  return *this;
}

Parameter& Parameter::sizes(std::vector<std::size_t> allowed) {
  size_list = std::move(allowed);
  return *this;
}

Parameter& Parameter::may_vary(std::string_view field) {
  field_name = field;
  given = std::make_shared<GivenValue>();
  return *this;
}

Parameter& Parameter::only_with(std::string_view other_key, std::vector<std::string> values) {
  condition_key = other_key;
  condition_values = std::move(values);
  return *this;
}

std::string Parameter::condition_text() const {
  std::string text;
  for (std::size_t n = 0; n < condition_values.size(); ++n) {
    const std::string& value = condition_values[n];
    if (n > 0) text += n + 1 < condition_values.size() ? ", " : " or ";
    text += value == "true" || value == "false" ? value : text_literal(value);
  }
  return text.empty() ? text : condition_key + " = " + text;
}

std::string Parameter::type_text() const {
  struct Names {
    const Parameter& self;
    std::string operator()(const double*) const { return "number" + variations(); }
    std::string operator()(const std::optional<double>*) const {
      return self.word.empty() ? "number" : "number or " + text_literal(self.word);
    }
    std::string operator()(const WordOrNumber*) const {
      std::string text;
      for (const auto& one : self.word_list) text += text_literal(one) + (&one == &self.word_list.back() ? "" : ", ");
      return text + " or number";
    }
    std::string operator()(const std::int64_t*) const { return "integer"; }
    std::string operator()(const bool*) const { return "true or false"; }
    std::string operator()(const std::string*) const { return "text"; }
    std::string operator()(const std::vector<double>*) const {
      return "list of " + numbers() + (self.given ? ", expressions or images" : "");
    }
    std::string operator()(const std::vector<std::string>*) const { return "list of texts"; }
    std::string operator()(const Rows*) const { return "list of lists of " + numbers(); }
    [[nodiscard]] std::string variations() const { return self.given ? ", expression or image" : ""; }
    [[nodiscard]] std::string numbers() const {
      return self.size_list.empty() ? "numbers" : sizes_text(self.size_list) + " numbers";
    }
  };
  return std::visit(Names{*this}, target);
}

std::string Parameter::value_text() const {
  const auto value = current_value(*this);
  return value ? inline_text(*value) : "";
}

std::string Parameter::range_text() const {
  if (!choice_list.empty()) {
    std::string text;
    for (const auto& choice : choice_list) text += (text.empty() ? "one of: " : ", ") + choice;
    return text;
  }
  const bool low = std::isfinite(lowest);
  const bool high = std::isfinite(highest);
  if (low && high && !lowest_excluded && !highest_excluded) return fmt::format("{} to {}", lowest, highest);
  std::string text;
  if (low) text = fmt::format("{} {}", lowest_excluded ? ">" : ">=", lowest);
  if (low && high) text += " and ";
  if (high) text += fmt::format("{} {}", highest_excluded ? "<" : "<=", highest);
  return text;
}

const Parameter* ParameterList::find(std::string_view name) const {
  const auto found =
      std::ranges::find_if(parameters_, [&](const Parameter& parameter) { return parameter.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

bool ParameterList::applies(const Parameter& parameter) const {
  if (parameter.condition_key.empty()) return true;
  const Parameter* const other = find(parameter.condition_key);
  if (other == nullptr)
    throw Error(ExitCode::plugin_refused,
                fmt::format(R"(the parameter "{}" depends on "{}", which is not declared: name a key of this list)",
                            parameter.name, parameter.condition_key));
  const auto value = current_value(*other);
  if (!value) return false;
  const auto* const text = value->as<std::string>();
  return std::ranges::find(parameter.condition_values, text != nullptr ? *text : inline_text(*value)) !=
         parameter.condition_values.end();
}

Parameter& ParameterList::add(std::string_view name, Parameter::Target target) {
  for (const auto& other : parameters_) {
    // "bulk" beside "bulk.A" would be a number and a table at once.
    const auto within = [](std::string_view inner, std::string_view outer) {
      return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
    };
    if (within(name, other.name) || within(other.name, name))
      throw Error(ExitCode::plugin_refused, other.name == name
                                                ? fmt::format("declares the parameter \"{}\" twice", name)
                                                : fmt::format("declares the parameters \"{}\" and \"{}\", of which "
                                                              "one is a table that holds the other",
                                                              other.name, name));
  }
  Parameter parameter;
  parameter.name = name;
  parameter.target = target;
  return parameters_.emplace_back(std::move(parameter));
}

Parameter& ParameterList::number(std::string_view name, double& target) { return add(name, &target); }

Parameter& ParameterList::number_or(std::string_view name, std::optional<double>& target, std::string_view word) {
  auto& parameter = add(name, &target);
  parameter.word = word;
  return parameter;
}

Parameter& ParameterList::word_or_number(std::string_view name, WordOrNumber& target, std::vector<std::string> words) {
  auto& parameter = add(name, &target);
  parameter.word_list = std::move(words);
  return parameter;
}

Parameter& ParameterList::integer(std::string_view name, std::int64_t& target) { return add(name, &target); }
Parameter& ParameterList::flag(std::string_view name, bool& target) { return add(name, &target); }
Parameter& ParameterList::text(std::string_view name, std::string& target) { return add(name, &target); }
Parameter& ParameterList::numbers(std::string_view name, std::vector<double>& target) { return add(name, &target); }
Parameter& ParameterList::texts(std::string_view name, std::vector<std::string>& target) { return add(name, &target); }
Parameter& ParameterList::rows(std::string_view name, Parameter::Rows& target) { return add(name, &target); }

}  // namespace mesogen
