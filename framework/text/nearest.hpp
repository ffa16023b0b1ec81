#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// The candidate that a misspelt word most likely means; empty if none is close.
MESOGEN_EXPORT std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean \"activity\"?", or an empty text if no candidate is close.
MESOGEN_EXPORT std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace mesogen
