#pragma once

#include <optional>
#include <vector>

#include "case/value.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen {

/// A key as it was declared, for telling about it; outlives the variable that the declaration was bound to.
struct DeclaredKey {
  Parameter parameter;  ///< its target is null
  /// The default. None if the key is required, or if the variable holds what the key itself would refuse: its default
  /// then depends on other keys, and the doc text tells how.
  std::optional<Value> default_value;
};

/// To be called before a case is read into the targets.
MESOGEN_EXPORT std::vector<DeclaredKey> declared_keys(const ParameterList& list);

}  // namespace mesogen
