#pragma once

#include <filesystem>
#include <optional>

#include "mesogen/export.hpp"

namespace mesogen {

/// The memory that the control groups of this process still leave it, bytes: the least over its group and all groups
/// around it. A container or a batch system sets such limits, and ends a process that goes beyond. Files that the
/// kernel holds in memory count as free where it can drop them. Nothing if no limit is set. `root`: where /proc and
/// /sys are looked for, "/" but in tests. Reads version 2 (memory.max) and version 1 (memory.limit_in_bytes).
MESOGEN_EXPORT std::optional<double> memory_left_in_groups(const std::filesystem::path& root);

/// What the limit on the address space (ulimit -v) still leaves, bytes. Nothing if there is none.
MESOGEN_EXPORT std::optional<double> address_space_left();

}  // namespace mesogen
