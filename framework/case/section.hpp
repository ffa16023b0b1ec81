#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "case/problems.hpp"
#include "case/units.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen {

struct Value;

/// One table of a case, which may be missing from the file: it then has no keys.
class MESOGEN_EXPORT CaseSection {
 public:
  CaseSection();
  /// `table` may be null for a missing section; `place` is what errors about the whole section point to.
  /// `units`: those of its numbers, for messages.
  CaseSection(std::string path, std::shared_ptr<const Value> table, SourcePlace place, Units units = {});

  /// "physics.flow"
  [[nodiscard]] const std::string& path() const { return path_; }
  /// "flow"
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const SourcePlace& place() const { return place_; }
  [[nodiscard]] const Units& units() const { return units_; }
  [[nodiscard]] bool given() const { return table_ != nullptr; }
  [[nodiscard]] bool has(std::string_view key) const;
  /// Place of the value of a key ("bulk.A" too), or of the innermost table that is there.
  [[nodiscard]] SourcePlace place_of(std::string_view key) const;
  /// "physics.flow.viscosity"
  [[nodiscard]] std::string full_key(std::string_view key) const;
  /// The text under the key `type`; empty if it is missing or no text.
  [[nodiscard]] std::string type() const;

  /// Fills every parameter's target from the table. Reports unknown keys with the nearest valid one, wrong types and
  /// ranges, and missing required keys; a target keeps its default where its key is missing or wrong.
  /// `other_keys` are keys of the section that somebody else reads.
  void read(const ParameterList& list, Problems& problems, const std::vector<std::string>& other_keys = {}) const;
  /// The same for these parameters alone; says nothing of other keys.
  void read_only(const ParameterList& list, Problems& problems) const;

 private:
  std::string path_;
  std::shared_ptr<const Value> table_;
  SourcePlace place_;
  Units units_;
};

}  // namespace mesogen
