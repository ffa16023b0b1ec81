#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "mesogen/export.hpp"

namespace mesogen::mesh {

/// A regular grid over a periodic box and the wave vectors that its Fourier modes stand for. Points and modes are
/// stored with the first axis fastest; along it, modes of real fields go up to half the number of points.
template <int Dim>
struct Grid {
  std::array<int, Dim> points{};     ///< along each axis, even
  std::array<double, Dim> length{};  ///< of the box, m

  [[nodiscard]] double spacing(int axis) const { return length[axis] / points[axis]; }
  [[nodiscard]] std::size_t point_count() const {
    std::size_t count = 1;
    for (int d = 0; d < Dim; ++d) count *= static_cast<std::size_t>(points[d]);
    return count;
  }
  /// Along the first axis, of real fields.
  [[nodiscard]] int modes_in_row() const { return points[0] / 2 + 1; }
  /// Rows along the first axis.
  [[nodiscard]] int row_count() const { return static_cast<int>(point_count()) / points[0]; }
  [[nodiscard]] std::size_t mode_count() const {
    return static_cast<std::size_t>(row_count()) * static_cast<std::size_t>(modes_in_row());
  }
  /// Wave number of the n-th mode along an axis, 1/m.
  [[nodiscard]] double wave_number(int axis, int n) const {
    return 2.0 * std::numbers::pi / length[axis] * (2 * n <= points[axis] ? n : n - points[axis]);
  }
  /// Largest wave number along an axis that the grid can tell from others, 1/m.
  [[nodiscard]] double highest(int axis) const { return std::numbers::pi / spacing(axis); }

  /// Coordinates of the r-th row: those along the axes beyond the first.
  void row_coordinates(int row, std::array<int, Dim>& at) const {
    at[0] = 0;
    for (int d = 1; d < Dim; ++d) {
      at[d] = row % points[d];
      row /= points[d];
    }
  }

  bool operator==(const Grid&) const = default;
};

/// Loops over fewer points or modes are left to one thread: several would wait for each other longer than they compute.
inline constexpr int parallel_threshold = 4096;

/// The even number nearest to `wanted`, at least 8, without other factors than 2, 3 and 5: what a Fourier transform
/// takes fast.
MESOGEN_EXPORT int fast_size(double wanted);

}  // namespace mesogen::mesh
