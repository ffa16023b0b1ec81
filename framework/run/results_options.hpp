#pragma once

#include <filesystem>

#include "output/results_content.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// What is written of a run in a folder whatever its plugins are.
ResultsOptions results_options(const Setup& setup, const std::filesystem::path& folder);

}  // namespace mesogen
