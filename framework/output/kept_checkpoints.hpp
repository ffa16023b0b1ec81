#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"

/// Checkpoints that stay for good: the files checkpoints/step0000001500_t12.5.h5 of a run's folder.
namespace mesogen {

constexpr const char* kept_checkpoints_folder = "checkpoints";

struct KeptCheckpoint {
  std::string name;  ///< relative to the run's folder
  std::int64_t step = 0;
  double time = 0.0;  ///< s, to twelve digits
};

/// Writes a checkpoint to a file of its own; on disk when it returns. Throws Error(run_failed).
MESOGEN_EXPORT void keep_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// All that a folder has, by step.
MESOGEN_EXPORT std::vector<KeptCheckpoint> kept_checkpoints(const std::filesystem::path& folder);

/// Removes those later than a step; with -1 all, and their folder.
MESOGEN_EXPORT void remove_kept_checkpoints(const std::filesystem::path& folder, std::int64_t last_step);

}  // namespace mesogen
