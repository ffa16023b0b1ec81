#pragma once

#include <fmt/format.h>

#include <string>

namespace mesogen {

/// A number for a message: six digits.
inline std::string rounded_text(double value) { return fmt::format("{:.6g}", value); }

}  // namespace mesogen
