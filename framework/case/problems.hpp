#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// Where something stands in a case. Line and column count from 1; line 0: no line, such as on the command line.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;

  /// "case.toml:12:3", or only the file where there is no line.
  [[nodiscard]] MESOGEN_EXPORT std::string text() const;
};

/// Collects all errors of a case, so that the user sees them at once.
class MESOGEN_EXPORT Problems {
 public:
  /// `key` is the full key, "physics.flow.viscosity"; empty where no key is meant.
  void add(const SourcePlace& place, const std::string& key, const std::string& text);
  /// A text of several lines, such as a chain of passes; all but the first are indented.
  void add_lines(const SourcePlace& place, std::string_view text);
  [[nodiscard]] bool empty() const { return lines_.empty(); }
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  /// One line each: "case.toml:12:3: physics.flow.viscosity: must be > 0 Pa s, but is -0.4".
  [[nodiscard]] std::string text() const;
  /// Throws Error(ExitCode::bad_case, text()) if there is any.
  void throw_if_any() const;

 private:
  std::vector<std::string> lines_;
};

}  // namespace mesogen
