#pragma once

#include <string>

#include "mesogen/export.hpp"

namespace mesogen {

/// A text for people, as std::printf makes it: formatted("%.3g spacings", 1.5). For plugins, which link no library for
/// it.
[[gnu::format(printf, 1, 2)]] MESOGEN_EXPORT std::string formatted(const char* format, ...);

}  // namespace mesogen
