#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "prescribed/program.hpp"

namespace mesogen {

/// The names that an expression may use beside x, y, z, pi and functions.
struct Vocabulary {
  int dimension = 2;
  bool time = true;  ///< t too
  std::map<std::string, double, std::less<>> constants;
  std::vector<std::string> fields;                          ///< scalar fields of particles
  std::map<std::string, std::string, std::less<>> refused;  ///< others, and why
};

/// With the constants of a scene and the edges Lx, Ly, Lz of its box.
[[nodiscard]] Vocabulary vocabulary_of(const Scene& scene);

/// Reads "0.08 * (x < 5)". Throws Error(bad_case) that tells what is wrong with the text.
[[nodiscard]] MESOGEN_EXPORT Program parse_expression(const std::string& text, const Vocabulary& words);

}  // namespace mesogen
