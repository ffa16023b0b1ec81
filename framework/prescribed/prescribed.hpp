#pragma once

#include <string>
#include <vector>

#include "case/section.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/rank.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/passes.hpp"
#include "prescribed/expression.hpp"
#include "prescribed/program.hpp"

namespace mesogen {

/// A number of a physics plugin, or a list of one for each axis, that a case prescribes in space and time. It becomes a
/// field.
struct MESOGEN_EXPORT Prescribed {
  std::string owner;    ///< "physics.activity"
  CaseSection section;  ///< where it is given
  Parameter parameter;  ///< bound to the numbers of the plugin, which hold those of largest size
  std::vector<Program> components = {};
  std::vector<double> largest = {};  ///< of each component, the value of largest size

  [[nodiscard]] const std::string& field() const { return parameter.field_name; }
  [[nodiscard]] Rank rank() const { return is_list() ? Rank::vector : Rank::scalar; }
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool reads_fields() const;
  /// Where place and time alone determine a scalar, its gradient is known too.
  [[nodiscard]] bool has_gradient() const { return !is_list() && !reads_fields(); }
  [[nodiscard]] bool constant() const;
  [[nodiscard]] bool changes_in_time() const;
};

/// What a case prescribes of these parameters, which were read from that section.
std::vector<Prescribed> prescribed_in(const std::string& owner, const CaseSection& section, const ParameterList& list);

/// Makes the programs. Problems are reported with their places.
void make_programs(Prescribed& prescribed, const Vocabulary& words, Problems& problems);

/// Makes programs of the numbers that the plugin has.
void take_numbers(Prescribed& prescribed);

/// The values of the case, for a message.
MESOGEN_EXPORT std::string shown(const Prescribed& prescribed);

/// Sets the numbers of the plugin to those of largest size.
void set_numbers(const Prescribed& prescribed);

/// What is wrong with a value: "must be >= 0 Pa s everywhere"; empty if nothing is.
std::string what_is_wrong(const Prescribed& prescribed, double value);

/// The value of the case for a component.
const Value& value_of(const Prescribed& prescribed, std::size_t component);

/// The bounds of the field during a run: those of the parameter, and how much larger than at the start values may get
/// before limits on the step no longer hold. Of a vector they are about its length.
FieldBounds bounds_of(const Prescribed& prescribed);

/// "physics.activity.activity"
std::string full_key(const Prescribed& prescribed);

}  // namespace mesogen
