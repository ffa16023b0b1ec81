#pragma once

#include <cstdint>

#include "mesogen/export.hpp"

namespace mesogen {

/// Processor time of this process so far, all threads together, s.
MESOGEN_EXPORT double cpu_seconds();

/// The most memory that this program ever had resident, bytes; 0 where the system does not tell. Not getrusage's
/// ru_maxrss, which a process inherits from the one that started it.
MESOGEN_EXPORT std::int64_t peak_memory();

/// The memory that this program has resident now, bytes; 0 where the system does not tell.
MESOGEN_EXPORT std::int64_t resident_memory();

/// The memory that this program can still have, bytes: what is free on the machine, or less where a control group or
/// a limit on the address space allows less. 0 where the system does not tell.
MESOGEN_EXPORT std::int64_t available_memory();

}  // namespace mesogen
