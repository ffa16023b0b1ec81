#pragma once

#include <string>

#include "mesogen/export.hpp"

namespace mesogen {

/// Formats a text for people, as std::printf does: formatted("%.3g spacings", 1.5). For plugins, which link no
/// formatting library.
[[gnu::format(printf, 1, 2)]] MESOGEN_EXPORT std::string formatted(const char* format, ...);

}  // namespace mesogen
