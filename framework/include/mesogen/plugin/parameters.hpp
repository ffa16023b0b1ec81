#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// A number, or one of several words.
struct WordOrNumber {
  std::string word;  ///< empty: it is the number
  double number = 0.0;
};

struct GivenValue;

/// One key of a section of a case. Parsing, checks, `plugin info` and the docs all use it, and nothing else.
struct MESOGEN_EXPORT Parameter {
  using Rows = std::vector<std::vector<double>>;
  /// Variable that receives the value. The value that it has when the parameter is declared is the default.
  using Target = std::variant<double*, std::optional<double>*, std::int64_t*, bool*, std::string*, std::vector<double>*,
                              std::vector<std::string>*, Rows*, WordOrNumber*>;

  std::string name;  ///< "viscosity"; "bulk.A" means key A of the table `bulk`
  Target target;
  std::string unit_text = "1";
  std::string doc_text;
  std::string word;  ///< word that a case may give instead of an optional number: "auto"
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_excluded = false;
  bool highest_excluded = false;
  bool is_required = false;
  std::vector<std::string> word_list;    ///< words that a case may give in place of a WordOrNumber's number
  std::vector<std::string> choice_list;  ///< allowed values of a text, or of each text of a list; empty: any
  std::vector<std::size_t> size_list;    ///< allowed lengths of a list of numbers, or of each row; empty: any
  std::string condition_key;             ///< see only_with; empty: no condition
  std::vector<std::string> condition_values;
  std::string field_name;             ///< see may_vary; empty: it may not
  std::shared_ptr<GivenValue> given;  ///< what a case gave in place of numbers; null if it may not vary

  Parameter& unit(std::string_view text);
  Parameter& doc(std::string_view text);
  /// Bounds of a number, or of each number in a list.
  Parameter& at_least(double bound);
  Parameter& above(double bound);
  Parameter& at_most(double bound);
  Parameter& below(double bound);
  /// The case must give this key: it has no default.
  Parameter& required();
  Parameter& choices(std::vector<std::string> allowed);
  Parameter& sizes(std::vector<std::size_t> allowed);
  /// A number of a physics plugin, or a list of one number for each axis, for which a case may prescribe values in
  /// space and time: an expression, "0.08 * (x < 5)", or an image. The values are then a field of this name, a scalar
  /// or a vector, which passes read (Pass::reads_if_present), with the gradient NAME_gradient of a scalar. The target
  /// gets, for each component, the value of largest size, for limits on the step and advice; Scene::varying tells that
  /// it varies. Bounds hold for all values. Where an expression comes out the same everywhere there is no field.
  Parameter& may_vary(std::string_view field);
  /// The key is valid only if another key of the same list, declared before it, has one of these values (a choice, the
  /// word of an optional number, "true" or "false"). Otherwise a case must not give it, even if it is required().
  Parameter& only_with(std::string_view other_key, std::vector<std::string> values);

  /// "number", "number or \"auto\"", "integer", "true or false", "text", "list of numbers", ...
  [[nodiscard]] std::string type_text() const;
  /// The present value of the target, as TOML writes it. Before a case is read this is the default.
  [[nodiscard]] std::string value_text() const;
  /// "> 0", "0 to 1", "one of: a, b"; empty if every value is allowed.
  [[nodiscard]] std::string range_text() const;
  /// The condition of only_with: `type = "modes"`, `anchoring = "planar" or "angle"`; empty if there is none.
  [[nodiscard]] std::string condition_text() const;
};

/// The keys of a plugin, or of a section of the case. Each call binds a key to a variable of the caller, which must
/// live longer than the list. Use the returned reference for `.unit().doc().above()...`.
class MESOGEN_EXPORT ParameterList {
 public:
  Parameter& number(std::string_view name, double& target);
  /// A number, or `word`, which leaves the target without a value: the plugin then decides by itself.
  Parameter& number_or(std::string_view name, std::optional<double>& target, std::string_view word);
  /// A number, or one of these words.
  Parameter& word_or_number(std::string_view name, WordOrNumber& target, std::vector<std::string> words);
  Parameter& integer(std::string_view name, std::int64_t& target);
  Parameter& flag(std::string_view name, bool& target);
  Parameter& text(std::string_view name, std::string& target);
  Parameter& numbers(std::string_view name, std::vector<double>& target);
  Parameter& texts(std::string_view name, std::vector<std::string>& target);
  /// A list of lists of numbers: [[1, 0, 0.05, 0.3], ...].
  Parameter& rows(std::string_view name, Parameter::Rows& target);

  [[nodiscard]] const std::deque<Parameter>& all() const { return parameters_; }
  /// A key of an earlier version. A case that gives it is refused; `advice` says what to write instead.
  void moved(std::string_view name, std::string_view advice) { moved_.insert_or_assign(std::string(name), advice); }
  /// The advice for such a key; empty if there is none.
  [[nodiscard]] std::string moved_advice(const std::string& name) const {
    const auto found = moved_.find(name);
    return found == moved_.end() ? std::string() : found->second;
  }
  /// The parameter of this name; nullptr if there is none.
  [[nodiscard]] const Parameter* find(std::string_view name) const;
  /// Returns true if the condition of a parameter of this list holds for the present values of the targets.
  [[nodiscard]] bool applies(const Parameter& parameter) const;

 private:
  Parameter& add(std::string_view name, Parameter::Target target);
  std::deque<Parameter> parameters_;
  std::map<std::string, std::string> moved_;
};

}  // namespace mesogen
