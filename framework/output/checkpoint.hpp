#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/rank.hpp"
#include "output/run_record.hpp"

namespace mesogen {

/// Everything needed to continue a run to the same bits.
struct Checkpoint {
  std::int64_t step = 0;
  double time = 0.0;       ///< s
  double step_size = 0.0;  ///< s
  std::string case_text;
  std::string version;
  std::string instruction_sets;  ///< of the code that the run computed with
  Precision precision = Precision::single_precision;
  int dimension = 0;  ///< of space
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<std::int64_t>> integers;
  std::map<std::string, std::map<std::string, std::vector<double>>> observers;  ///< by observer, what it saved
  RunCost cost;                                                                 ///< of the run until then
  EndRecords end_records;  ///< of this state, where the run ended with it
  /// s. The last steps were shortened to end at this time, only because the run was to end there: a run to a later end
  /// passes through other states. Nothing where that is not so.
  std::optional<double> shortened_for;
  std::optional<BranchOrigin> origin;  ///< of a branch
  bool starts_branch = false;          ///< nothing is recorded yet: observers start with this state

  bool operator==(const Checkpoint&) const = default;
};

/// Where the newest lie in the folder of a run; see write_checkpoint() and write_checkpoint_before_end().
inline constexpr std::array newest_checkpoint_names = {"checkpoint_a.h5", "checkpoint_b.h5",
                                                       "checkpoint_before_end.h5"};

/// Replaces the older of the folder's two checkpoints, checkpoint_a.h5 and checkpoint_b.h5. The file appears whole or
/// not at all and is on disk when this returns. Throws Error(run_failed).
MESOGEN_EXPORT void write_checkpoint(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// Keeps a checkpoint as checkpoint_before_end.h5, in place of an earlier one there: the last state that a run to a
/// later end has as well. See Checkpoint::shortened_for.
MESOGEN_EXPORT void write_checkpoint_before_end(const std::filesystem::path& folder, const Checkpoint& checkpoint);

/// Is there a checkpoint, valid or not? If not, a killed run starts anew.
MESOGEN_EXPORT bool has_checkpoint(const std::filesystem::path& folder);

/// Reads one file. Throws Error(bad_case) if it is truncated, damaged, or not a checkpoint.
MESOGEN_EXPORT Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Says why a checkpoint does not fit (other version, other case); empty if it does.
using CheckpointCheck = std::function<std::string(const Checkpoint&)>;

/// The newest checkpoint of a folder, of the three that it may hold, that is whole and passes `check`. `which` is given
/// its file name, `refused` a line for each newer one that was not used: "checkpoint_b.h5: truncated: ...". Throws
/// Error(bad_case) with all reasons if there is none.
MESOGEN_EXPORT Checkpoint read_newest_checkpoint(const std::filesystem::path& folder, std::string* which = nullptr,
                                                 std::vector<std::string>* refused = nullptr,
                                                 const CheckpointCheck& check = {});

}  // namespace mesogen
