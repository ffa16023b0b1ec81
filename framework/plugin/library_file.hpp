#pragma once

#include <filesystem>
#include <string>

namespace mesogen::plugin {

/// Why this file cannot be a library for this machine; empty if it can. Looked at before the dynamic linker is: that
/// one maps a library by its header, so a file cut short (a copy that was interrupted) would kill the process.
std::string library_problem(const std::filesystem::path& file);

}  // namespace mesogen::plugin
