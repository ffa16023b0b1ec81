#pragma once

#include <string>
#include <vector>

namespace mesogen::app {

/// Becomes the Python program `module` of the package mesogen, which then speaks as `mesogen <verb>`: this process is
/// replaced, so it never returns. Throws Error(run_failed) where Python or the package is missing.
[[noreturn]] void hand_over(const std::string& verb, const std::string& module,
                            const std::vector<std::string>& arguments);

}  // namespace mesogen::app
