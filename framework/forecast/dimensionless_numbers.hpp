#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A number that tells what kind of scene this is.
struct SceneNumber {
  std::string name;  ///< "active_length", also its key for programs
  double value = 0.0;
  std::string unit;     ///< "1" where it has none
  std::string meaning;  ///< "l_Q = sqrt(K / |zeta|)"
};

/// Those that the scene's plugins define, by the constants that they publish; a plain fluid has no active length.
/// Lengths and speeds that numbers are made from come before them. `director`: the angle of a director that is uniform
/// at first, rad; none: instabilities are those of the director that suits each best.
MESOGEN_EXPORT std::vector<SceneNumber> dimensionless_numbers(const Scene& scene, std::optional<double> director = {});

/// The speed that a scene's numbers are made with, m/s: what the case expects (or starts with, or its walls move
/// with), or else what the active stress drives over the active length against viscosity; 0 if nothing is known.
MESOGEN_EXPORT double expected_speed(const Scene& scene);

}  // namespace mesogen
