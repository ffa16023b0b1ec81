#pragma once

#include <filesystem>

namespace mesogen::app {

/// Folder of this installation, or of this build: the command is in its bin, the libraries are in its lib.
inline std::filesystem::path installation() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

}  // namespace mesogen::app
