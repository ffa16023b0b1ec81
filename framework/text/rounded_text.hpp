#pragma once

#include <fmt/format.h>

#include <string>

#include "case/units.hpp"

namespace mesogen {

/// A number for a message: six digits.
inline std::string rounded_text(double value) { return fmt::format("{:.6g}", value); }

/// A time of a run for a message, with the unit of its case.
inline std::string time_text(double time, const Units& units) { return rounded_text(time) + " " + units.time; }

}  // namespace mesogen
