#include "case/parameter_value.hpp"

#include <algorithm>
#include <cmath>

#include "case/given_value.hpp"
#include "case/toml_text.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

using Strings = std::vector<std::string>;

/// Reads a value, and its elements, for one parameter; each function returns nothing after a refusal.
class Taker {
 public:
  explicit Taker(const Parameter& parameter) : parameter_(parameter) {}

  std::optional<Refusal> refusal;

  void operator()(double* target, const Value& value) {
    if (!varies(value)) keep(target, number(value, ""));
  }
  void operator()(std::optional<double>* target, const Value& value) {
    const auto* const text = value.as<std::string>();
    if (text != nullptr && !parameter_.word.empty() && *text == parameter_.word) {
      target->reset();
    } else {
      keep(target, number(value, ""));
    }
  }
  void operator()(WordOrNumber* target, const Value& value) {
    if (const auto* const word = value.as<std::string>()) {
      if (std::ranges::find(parameter_.word_list, *word) != parameter_.word_list.end()) {
        *target = {*word, 0.0};
      } else {
        refuse_type(value);
        refusal->text += did_you_mean(*word, parameter_.word_list);
      }
    } else if (const auto given = number(value, "")) {
      *target = {"", *given};
    }
  }
  void operator()(std::int64_t* target, const Value& value) {
    const auto* const integer = value.as<std::int64_t>();
    if (integer == nullptr) return refuse_type(value);
    if (in_range(static_cast<double>(*integer), value, "")) *target = *integer;
  }
  void operator()(bool* target, const Value& value) {
    const auto* const flag = value.as<bool>();
    if (flag == nullptr) return refuse_type(value);
    *target = *flag;
  }
  void operator()(std::string* target, const Value& value) { keep(target, text(value)); }
  void operator()(std::vector<double>* target, const Value& value) {
    if (!varies(value)) keep(target, numbers(value));
  }
  void operator()(Strings* target, const Value& value) {
    const auto* const list = value.as<Value::List>();
    if (list == nullptr) return refuse_type(value);
    Strings texts;
    for (const auto& element : *list) {
      auto element_text = text(element);
      if (!element_text) return;
      texts.push_back(std::move(*element_text));
    }
    *target = std::move(texts);
  }
  void operator()(Parameter::Rows* target, const Value& value) {
    const auto* const list = value.as<Value::List>();
    if (list == nullptr) return refuse_type(value);
    Parameter::Rows rows;
    for (const auto& element : *list) {
      auto row = numbers(element);
      if (!row) return;
      rows.push_back(std::move(*row));
    }
    *target = std::move(rows);
  }

 private:
  /// Is it prescribed in space and time? It is then kept as it stands.
  bool varies(const Value& value) {
    const auto prescribes = [](const Value& one) {
      return one.as<std::string>() != nullptr || one.as<Value::Table>() != nullptr;
    };
    const auto* const list = value.as<Value::List>();
    if (!parameter_.given) return false;
    if (std::holds_alternative<double*>(parameter_.target) ? !prescribes(value)
                                                           : list == nullptr || std::ranges::none_of(*list, prescribes))
      return false;
    if (list != nullptr && !right_size(*list)) {
      refuse_type(value);
    } else {
      parameter_.given->value = value;
    }
    return true;
  }
  [[nodiscard]] bool right_size(const Value::List& list) const {
    const auto& sizes = parameter_.size_list;
    return sizes.empty() || std::ranges::find(sizes, list.size()) != sizes.end();
  }

  [[nodiscard]] std::string with_unit(const std::string& text) const {
    return parameter_.unit_text == "1" ? text : text + " " + parameter_.unit_text;
  }

  template <class Target, class Type>
  static void keep(Target* target, std::optional<Type> value) {
    if (value) *target = std::move(*value);
  }

  void refuse(const Value& value, const std::string& must) {
    refusal = Refusal{value.place, must + ", but is " + shown(value)};
  }
  void refuse_type(const Value& value) { refuse(value, "must be " + expected_text(parameter_)); }

  bool in_range(double number, const Value& value, const std::string& whose) {
    std::string range = parameter_.range_text();
    if (range.find(" to ") != std::string::npos) range.insert(0, "from ");
    if (!std::isfinite(number)) {
      refuse(value, whose + (range.empty() ? "must be finite" : with_unit("must be finite and " + range)));
      return false;
    }
    const bool low = number < parameter_.lowest || (parameter_.lowest_excluded && number == parameter_.lowest);
    const bool high = number > parameter_.highest || (parameter_.highest_excluded && number == parameter_.highest);
    if (!low && !high) return true;
    refuse(value, with_unit(whose + "must be " + range));
    return false;
  }

  std::optional<double> number(const Value& value, const std::string& whose) {
    double number = 0.0;
    if (const auto* const floating = value.as<double>()) {
      number = *floating;
    } else if (const auto* const integer = value.as<std::int64_t>()) {
      number = static_cast<double>(*integer);
    } else {
      refuse_type(value);
      return std::nullopt;
    }
    return in_range(number, value, whose) ? std::optional(number) : std::nullopt;
  }

  std::optional<std::string> text(const Value& value) {
    const auto* const text = value.as<std::string>();
    const auto& choices = parameter_.choice_list;
    if (text == nullptr) {
      refuse_type(value);
      return std::nullopt;
    }
    if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end()) {
      refuse(value, "must be " + parameter_.range_text());
      refusal->text += did_you_mean(*text, choices);
      return std::nullopt;
    }
    return *text;
  }

  std::optional<std::vector<double>> numbers(const Value& value) {
    const auto* const list = value.as<Value::List>();
    if (list == nullptr || !right_size(*list)) {
      refuse_type(value);
      return std::nullopt;
    }
    std::vector<double> numbers;
    for (const auto& element : *list) {
      const auto element_number = number(element, "each number ");
      if (!element_number) return std::nullopt;
      numbers.push_back(*element_number);
    }
    return numbers;
  }

  const Parameter& parameter_;
};

template <class Elements, class Convert>
std::optional<Value> list_value(const Elements& elements, const Convert& convert) {
  Value::List list;
  for (const auto& element : elements) {
    auto value = convert(element);
    if (!value) return std::nullopt;
    list.push_back(std::move(*value));
  }
  return Value{std::move(list), {}};
}

struct Reader {
  const Parameter& parameter;

  std::optional<Value> operator()(const double* target) const { return number(*target); }
  std::optional<Value> operator()(const std::optional<double>* target) const {
    if (*target) return number(**target);
    return parameter.word.empty() ? std::nullopt : std::optional(Value{parameter.word, {}});
  }
  std::optional<Value> operator()(const WordOrNumber* target) const {
    return target->word.empty() ? number(target->number) : std::optional(Value{target->word, {}});
  }
  std::optional<Value> operator()(const std::int64_t* target) const { return Value{*target, {}}; }
  std::optional<Value> operator()(const bool* target) const { return Value{*target, {}}; }
  std::optional<Value> operator()(const std::string* target) const { return Value{*target, {}}; }
  std::optional<Value> operator()(const std::vector<double>* target) const { return list_value(*target, number); }
  std::optional<Value> operator()(const Strings* target) const {
    return list_value(*target, [](const std::string& text) { return std::optional(Value{text, {}}); });
  }
  std::optional<Value> operator()(const Parameter::Rows* target) const {
    return list_value(*target, [](const std::vector<double>& row) { return list_value(row, number); });
  }

  static std::optional<Value> number(double value) {
    return std::isfinite(value) ? std::optional(Value{value, {}}) : std::nullopt;
  }
};

}  // namespace

std::optional<Refusal> take_value(const Parameter& parameter, const Value& value) {
  Taker taker(parameter);
  std::visit([&](auto* target) { taker(target, value); }, parameter.target);
  return taker.refusal;
}

std::optional<Value> current_value(const Parameter& parameter) {
  if (parameter.given && parameter.given->value) return parameter.given->value;
  const Reader reader{parameter};
  return std::visit([&](const auto* target) { return reader(target); }, parameter.target);
}

std::string expected_text(const Parameter& parameter) {
  const std::string type = parameter.type_text();
  const std::string range = parameter.range_text();
  const bool list = type.starts_with("list");
  std::string text = type == "true or false" ? type : (type.starts_with("integer") ? "an " : "a ") + type;
  if (parameter.unit_text != "1") text += " in " + parameter.unit_text;
  if (!range.empty()) text += (list ? ", each " : ", ") + range;
  return text;
}

}  // namespace mesogen
