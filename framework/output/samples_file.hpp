#pragma once

#include <filesystem>

#include "mesogen/export.hpp"
#include "output/results_content.hpp"

namespace mesogen {

/// Writes samples to a file of their own, laid out as in results.h5. The file appears whole or not at all. Throws
/// Error(run_failed).
MESOGEN_EXPORT void write_samples(const std::filesystem::path& file, const ResultsOptions& options,
                                  const output::SampleStore& samples);

}  // namespace mesogen
