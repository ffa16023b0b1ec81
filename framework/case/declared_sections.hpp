#pragma once

#include <vector>

#include "case/declared_keys.hpp"
#include "case/framework_keys.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// A section with the framework's own keys. Those of plugins come on top.
struct DeclaredSection {
  case_keys::Section section;
  std::vector<DeclaredKey> keys;
};

/// All that a case may hold, as case/framework_keys declares it: for the schema and the reference.
MESOGEN_EXPORT std::vector<DeclaredSection> declared_sections();

}  // namespace mesogen
