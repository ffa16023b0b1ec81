#pragma once

#include <string>
#include <string_view>

#include "mesogen/export.hpp"

namespace mesogen {

/// "0.1.0"
MESOGEN_EXPORT std::string_view version();

/// How this library was built: compiler, build type, and the tag that plugins must match.
MESOGEN_EXPORT std::string build_text();

}  // namespace mesogen
