#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/text/formatted.hpp"

namespace mesogen {

/// A wave that fits the box: amplitude * cos(argument).
struct BoxWave {
  double kx;  ///< wave vector, 1/m
  double ky;
  double amplitude;
  double phase;  ///< rad

  [[nodiscard]] double argument(double x, double y) const { return kx * x + ky * y + phase; }
};

/// Waves from the rows of a parameter: waves in the box along x and along y, amplitude, phase (rad). Throws
/// BadParameter if a number of waves is not whole: the wave would jump at the faces of the box.
inline std::vector<BoxWave> box_waves(const std::string& key, const Parameter::Rows& rows, const Scene& scene) {
  std::vector<BoxWave> waves;
  for (const auto& row : rows) {
    for (const double number : {row[0], row[1]})
      if (number != std::round(number))
        throw BadParameter(
            key, formatted("row %zu: wave numbers must be whole, so that the wave fits the box, but one is %g",
                           waves.size() + 1, number));
    const double full_turn = 2.0 * std::numbers::pi;
    waves.push_back({full_turn * row[0] / scene.box[0], full_turn * row[1] / scene.box[1], row[2], row[3]});
  }
  return waves;
}

}  // namespace mesogen
