#pragma once

#include <string>
#include <string_view>

#include "mesogen/export.hpp"

namespace mesogen {

/// The units in which the numbers of a case are given, by its section [units]. They label messages, pictures and
/// results. No number is converted: all numbers of a case are in the same units, its viscosity in pN s/um2 where
/// lengths are in um and forces in pN.
struct Units {
  std::string length = "m";
  std::string time = "s";
  std::string force = "N";

  /// A unit as plugins declare it, of m, s, kg, N, Pa, J, in these units: "kg/(m3 s)" becomes "pN s/um4". In SI units,
  /// and where it has other words ("rad", "particle spacings"), it is left as it is. A list, "m, m/s, 1", is taken
  /// apart.
  [[nodiscard]] MESOGEN_EXPORT std::string text(std::string_view declared) const;
  /// A time for a message: "2.5 s".
  [[nodiscard]] MESOGEN_EXPORT std::string time_text(double seconds) const;
  /// Are these m, s and N?
  [[nodiscard]] bool si() const { return length == "m" && time == "s" && force == "N"; }
};

}  // namespace mesogen
