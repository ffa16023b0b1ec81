#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/declared_keys.hpp"
#include "case/framework_keys.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// The keys that a section has while one of them, such as `type`, holds a certain value.
struct SectionForm {
  std::string key;                  ///< the one that the others depend on; empty: there is one form
  std::optional<std::string> word;  ///< what it holds; none: anything else
  bool unless_given = false;        ///< this is also the form while that key is missing
  std::vector<DeclaredKey> keys;
};

/// A section with the framework's own keys in all its forms. Those of plugins come on top.
struct DeclaredSection {
  case_keys::Section section;
  std::vector<SectionForm> forms;
};

/// All that a case may hold, as case/framework_keys declares it: for the schema and the reference.
MESOGEN_EXPORT std::vector<DeclaredSection> declared_sections();

}  // namespace mesogen
