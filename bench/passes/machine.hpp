#pragma once

namespace mesogen::bench {

/// Registers what the machine can do at most, in the same units: memory that a core reads and writes, and operations
/// that it does on registers.
void add_machine();

}  // namespace mesogen::bench
