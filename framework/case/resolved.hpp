#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace mesogen {

/// The complete case as text: what the file says, overrides, and every default that a run used.
class MESOGEN_EXPORT ResolvedCase {
 public:
  /// Starts from Case::resolved_text's content.
  explicit ResolvedCase(const Case& source);
  ~ResolvedCase();
  ResolvedCase(const ResolvedCase&) = delete;
  ResolvedCase& operator=(const ResolvedCase&) = delete;

  /// Fills in a plugin's parameters with the values that their targets hold now, which is after reading the section.
  void add(const CaseSection& section, const ParameterList& list);
  /// The output fields that the scene has, where the case leaves them open.
  void set_output_fields(const std::vector<std::string>& fields);
  [[nodiscard]] std::string text() const;

 private:
  std::unique_ptr<Value> tree_;
};

}  // namespace mesogen
