#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "output/frame.hpp"
#include "output/run_record.hpp"
#include "output/sample_store.hpp"

namespace mesogen {

/// What is written of a run whatever its plugins are.
struct ResultsOptions {
  std::filesystem::path folder;  ///< made ready by start_run_folder()
  std::array<double, 3> box{};   ///< edges
  int dimension = 0;             ///< of space
  std::vector<bool> periodic;    ///< by axis
  std::string case_text;         ///< resolved
  std::string version;
  std::string build;
  std::int64_t seed = 0;
  Index count = 0;  ///< particles
  std::optional<BranchOrigin> origin = std::nullopt;
  std::string length_unit = "m";
  std::string time_unit = "s";
};

namespace output {

/// What results.h5 holds, without the values of the particles.
struct ResultsContent {
  std::vector<FieldShape> fields;  ///< in the order of their names
  std::vector<FrameStamp> frames;
  SampleStore samples;
  std::optional<RunCost> cost;  ///< of a finished run
};

}  // namespace output
}  // namespace mesogen
