#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesogen/plugin/boundary.hpp"

/// Scenes for tests of boundary plugins, and what every periodic one must hold.
namespace mesogen::test {

/// Coordinates by axis.
using Points = std::array<std::vector<double>, 3>;

/// A box of edges `box` (m) in so many dimensions.
Scene scene_of(int dimension, std::array<double, 3> box);
/// Centres of cells x cells (x cells) equal cells.
Points lattice(const Scene& scene, int cells);
/// Points anywhere in the box, the same for the same seed.
Points scattered(const Scene& scene, int count, unsigned seed);
struct GhostList {
  std::vector<Index> source;
  std::vector<std::array<double, 3>> offset;  ///< m
};
/// All ghosts of these points, by cell.
GhostList ghosts_of(const Boundary& boundary, const Scene& scene, const Points& points, double reach);

/// keep_inside brings any coordinate into [0, box), keeps the unwrapped path, and counts the boxes crossed.
void expect_keeps_inside(const std::string& boundary);

}  // namespace mesogen::test
