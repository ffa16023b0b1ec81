#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

#include "mesogen/mesh/pass_spectrum.hpp"

/// Meshes beside the particles, in code that nvcc compiled.
namespace mesogen::test {

/// Returns whether a pass that has no device is told so.
inline bool spectrum_asks_for_a_device() {
  mesh::Grid<2> grid;
  grid.length = {1.0, 1.0};
  grid.points = {8, 8};
  bool right = false;
  try {
    const mesh::PassSpectrum<2> spectrum(grid, nullptr);
  } catch (const std::logic_error& error) {
    right = std::string(error.what()).find("cannot work on the host") != std::string::npos;
  }
  std::printf("a mesh of a pass without a device: %s\n", right ? "refused" : "WRONG");
  return right;
}

}  // namespace mesogen::test
