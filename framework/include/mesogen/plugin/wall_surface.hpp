#pragma once

#include <array>
#include <string>
#include <vector>

namespace mesogen {

/// A piece of the surface of a wall.
struct SurfaceElement {
  std::array<double, 3> point{};   ///< in its middle, m
  std::array<double, 3> normal{};  ///< into the fluid, of length 1
  double area = 0.0;               ///< m; in three dimensions m2
};

/// The surface between a wall and the fluid, for observers: sums over its elements are integrals.
struct WallSurface {
  std::string name;                ///< "solids.rim"; of a face of the box that is not periodic "y_low"
  std::array<double, 3> centre{};  ///< about which torques are taken, m
  bool sticks = false;             ///< the fluid has its velocity there: no slip
  std::vector<SurfaceElement> elements;
};

}  // namespace mesogen
