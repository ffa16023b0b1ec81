#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "mesogen/export.hpp"

namespace mesogen::mesh {

/// A regular grid over a periodic box, and the wave vectors of its Fourier modes. Points and modes are stored with the
/// first axis fastest. Along the first axis, modes of real fields go up to half the number of points.
template <int Dim>
struct Grid {
  std::array<int, Dim> points{};     ///< number along each axis, even
  std::array<double, Dim> length{};  ///< of the box, m

  [[nodiscard]] MESOGEN_HOST_DEVICE double spacing(int axis) const { return length[axis] / points[axis]; }
  [[nodiscard]] MESOGEN_HOST_DEVICE std::size_t point_count() const {
    std::size_t count = 1;
    for (int d = 0; d < Dim; ++d) count *= static_cast<std::size_t>(points[d]);
    return count;
  }
  /// Number of modes along the first axis, for real fields.
  [[nodiscard]] MESOGEN_HOST_DEVICE int modes_in_row() const { return points[0] / 2 + 1; }
  /// Number of rows along the first axis.
  [[nodiscard]] MESOGEN_HOST_DEVICE int row_count() const { return static_cast<int>(point_count()) / points[0]; }
  [[nodiscard]] MESOGEN_HOST_DEVICE std::size_t mode_count() const {
    return static_cast<std::size_t>(row_count()) * static_cast<std::size_t>(modes_in_row());
  }
  /// Wave number of the n-th mode along an axis, 1/m.
  [[nodiscard]] MESOGEN_HOST_DEVICE double wave_number(int axis, int n) const {
    return 2.0 * std::numbers::pi / length[axis] * (2 * n <= points[axis] ? n : n - points[axis]);
  }
  /// Largest wave number along an axis that the grid can represent, 1/m.
  [[nodiscard]] double highest(int axis) const { return std::numbers::pi / spacing(axis); }

  /// Sets `at` to the coordinates of a row: at[0] = 0, the others are those along the second and third axis.
  MESOGEN_HOST_DEVICE void row_coordinates(int row, std::array<int, Dim>& at) const {
    at[0] = 0;
    for (int d = 1; d < Dim; ++d) {
      at[d] = row % points[d];
      row /= points[d];
    }
  }

  bool operator==(const Grid&) const = default;
};

/// Loops over fewer points or modes run on one thread: with several, waiting takes longer than computing.
inline constexpr int parallel_threshold = 4096;

/// Returns the even number nearest to `wanted` that is at least 8 and has no prime factors other than 2, 3 and 5. A
/// Fourier transform of such a size is fast.
MESOGEN_EXPORT int fast_size(double wanted);

}  // namespace mesogen::mesh
