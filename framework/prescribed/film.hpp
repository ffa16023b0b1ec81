#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// Pictures of the box, one after the other in time. Before the first and after the last they stand still; between two
/// times one fades into the next.
struct Film {
  int width = 0, height = 0;  ///< pixels
  std::vector<double> times;  ///< s, rising; a single picture has one time
  std::vector<float> pixels;  ///< brightness, 0 to 1: pictures, rows from the top down, pixels from the left

  /// Which pictures count at a time, and how far it is on the way from the first to the second.
  struct Moment {
    std::size_t before, after;
    double share;
  };
  [[nodiscard]] MESOGEN_EXPORT Moment at(double time) const;
  [[nodiscard]] const float* picture(std::size_t n) const {
    return pixels.data() + n * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Reads PNG files, of any depth; colours count by their luminance, and transparency does not. Throws Error(bad_case)
/// that names the file.
[[nodiscard]] MESOGEN_EXPORT Film read_film(const std::vector<std::string>& files, std::vector<double> times);

}  // namespace mesogen
