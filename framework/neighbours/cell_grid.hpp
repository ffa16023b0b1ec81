#pragma once

#include <array>
#include <cmath>

#include "mesogen/exec/unroll.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// The cells of a box: narrow along x, half as high as the search range across it, with padding beyond faces that do
/// not wrap. See Neighbours for what they are good for. Trivially copyable: loops on a device take it along.
class MESOGEN_EXPORT CellGrid {
 public:
  /// `range`: how far a neighbour may be when it is looked for, m.
  CellGrid(const Scene& scene, const Boundary& boundary, double range);

  static constexpr int cells_in_tile = 64;

  using Cell = std::array<int, 3>;

  /// Cell along one axis, not bounded by the box. A far one where the number fits no int, or the position is not a
  /// number.
  [[nodiscard]] MESOGEN_HOST_DEVICE int along(int axis, double position) const {
    constexpr int most = 1'000'000'000;
    const double at = ::floor(position / width_[axis]);
    if (!(at < most)) return most;
    return at > -most ? static_cast<int>(at) : -most;
  }
  /// Number of the cell inside the box that holds a position in it.
  [[nodiscard]] MESOGEN_HOST_DEVICE int number_of(const double* position) const {
    int number = 0;
    int cells_before = 1;
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) {
          const int at = along(d, position[d]);
          const int last = cells_[d] - 1;
          number += (at < 0 ? 0 : at > last ? last : at) * cells_before;
          cells_before *= cells_[d];
        });
    return number;
  }
  /// Coordinates of the n-th cell inside the box.
  [[nodiscard]] MESOGEN_HOST_DEVICE Cell inside(int number) const {
    Cell cell{};
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) {
          cell[d] = number % cells_[d];
          number /= cells_[d];
        });
    return cell;
  }
  /// Cell along an axis of a position in an image that lies `boxes` boxes away, clamped to the padding: rounding must
  /// not move it over a face.
  [[nodiscard]] MESOGEN_HOST_DEVICE int beside(int axis, double position, int boxes) const {
    const int lowest = boxes < 0 ? -padding_[axis] : boxes > 0 ? cells_[axis] : 0;
    const int highest = boxes < 0 ? -1 : boxes > 0 ? cells_[axis] + padding_[axis] - 1 : cells_[axis] - 1;
    const int at = along(axis, position);
    return at < lowest ? lowest : at > highest ? highest : at;
  }
  /// Cell inside the box nearest to a position.
  [[nodiscard]] Cell nearest_inside(const std::array<double, 3>& position) const;
  /// Index of a cell among all, the padding included.
  [[nodiscard]] MESOGEN_HOST_DEVICE int padded_index(const Cell& cell) const {
    int index = 0;
    int cells_before = 1;
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) {
          index += (cell[d] + padding_[d]) * cells_before;
          cells_before *= cells_[d] + 2 * padding_[d];
        });
    return index;
  }
  /// The same of the n-th cell inside the box.
  [[nodiscard]] MESOGEN_HOST_DEVICE int padded_index_of(int number) const {
    int index = 0;
    int cells_before = 1;
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) {
          index += (number % cells_[d] + padding_[d]) * cells_before;
          number /= cells_[d];
          cells_before *= cells_[d] + 2 * padding_[d];
        });
    return index;
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE int inside_count() const {
    int count = 1;
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) { count *= cells_[d]; });
    return count;
  }
  /// The cell of such an index.
  [[nodiscard]] MESOGEN_HOST_DEVICE Cell padded(int index) const {
    Cell cell{};
    exec::for_axes(
        dimension_, [&](auto d) __attribute__((always_inline)) {
          const int layers = cells_[d] + 2 * padding_[d];
          cell[d] = index % layers - padding_[d];
          index /= layers;
        });
    return cell;
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE int padded_count() const {
    int count = 1;
    for (int d = 0; d < dimension_; ++d) count *= cells_[d] + 2 * padding_[d];
    return count;
  }
  /// Where the tile of a cell begins along an axis, m.
  [[nodiscard]] MESOGEN_HOST_DEVICE double tile_origin(int axis, int cell) const {
    if (axis > 0) return cell * width_[axis];
    if (cell < 0) return -padding_[0] * width_[0];
    if (cell >= cells_[0]) return cells_[0] * width_[0];
    const int first_cell = cell / cells_in_tile * cells_in_tile;
    return first_cell * width_[0];
  }

  [[nodiscard]] MESOGEN_HOST_DEVICE int dimension() const { return dimension_; }
  [[nodiscard]] int cells(int axis) const { return cells_[axis]; }
  [[nodiscard]] int padding(int axis) const { return padding_[axis]; }
  [[nodiscard]] int reach(int axis) const { return reach_[axis]; }
  [[nodiscard]] bool wrapped(int axis) const { return wrapped_[axis]; }
  [[nodiscard]] double width(int axis) const { return width_[axis]; }

 private:
  int dimension_;
  std::array<int, 3> cells_{1, 1, 1};
  std::array<int, 3> padding_{};
  std::array<int, 3> reach_{};
  std::array<bool, 3> wrapped_{};
  std::array<double, 3> width_{};
};

}  // namespace mesogen
