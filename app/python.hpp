#pragma once

#include <string>

#include "command_line/verb.hpp"

namespace mesogen::app {

/// The option by which a program of ours learns with which `mesogen` to run cases: this one.
Forwarded with_this_mesogen();

/// Becomes the Python program `module` of the package mesogen, which then speaks as `mesogen <verb>`: this process is
/// replaced, so it never returns. Throws Error(run_failed) where Python or the package is missing.
[[noreturn]] ExitCode hand_over(const std::string& verb, const std::string& module, const Forwarded& given);

}  // namespace mesogen::app
