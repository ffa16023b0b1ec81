#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/field_kind.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// A field that a run keeps.
struct PlannedField {
  std::string name;
  int components = 1;
  bool integrated = false;        ///< with a master copy in double
  std::optional<FieldKind> kind;  ///< for the boundary
};

/// The fields that the plugins of a case need in memory: those that something keeps, reads or writes. What only pruned
/// work would touch takes none.
MESOGEN_EXPORT std::vector<PlannedField> planned_fields(const Setup& setup);

/// Names of what a checkpoint holds beside positions.
MESOGEN_EXPORT std::vector<std::string> checkpointed_fields(const Setup& setup);

}  // namespace mesogen
