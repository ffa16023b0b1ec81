#pragma once

#include <cstddef>

#include "mesogen/exec/unroll.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::mesh {

/// Particles in the order of the cells of a grid, as loops on a device see them. A cell has the number of the first
/// point that its particles use: the one below it along every axis. Numbers go along the first axis first.
template <int Dim, class Real>
struct CellsOfParticles {
  static constexpr int reach = 4;  // points along an axis that a particle uses
  static constexpr int rows = Dim > 2 ? reach* reach : reach;

  int points[Dim];
  Index count;
  const Index* particle;  // in the order of cells
  const Index* cell;      // of each, in that order
  const Index* begin;     // of each cell's particles, and one more
  const Real* fraction;   // position in the cell, 0 to 1, axis after axis

  /// Number of a point, or of a cell, from one that is up to `reach` beyond the last along an axis, or before the
  /// first.
  [[nodiscard]] MESOGEN_HOST_DEVICE int inside(int d, int at) const {
    return at < 0 ? at + points[d] : at >= points[d] ? at - points[d] : at;
  }
  /// The cubic B-spline of a point, `by` after the first that a particle uses along an axis.
  [[nodiscard]] MESOGEN_HOST_DEVICE static Real spline(int by, Real fraction) {
    const Real signed_distance = Real(by - 1) - fraction;
    const Real distance = signed_distance < Real(0) ? -signed_distance : signed_distance;
    const Real rest = Real(2) - distance;
    return distance < Real(1) ? Real(2.0 / 3.0) - distance * distance * (Real(1) - Real(0.5) * distance)
                              : rest * rest * rest * Real(1.0 / 6.0);
  }
  /// Weight of row r of those that a particle uses, the second axis fastest.
  [[nodiscard]] MESOGEN_HOST_DEVICE Real across(int r, Index n) const {
    Real weight = spline(r % reach, fraction[count + n]);
    if constexpr (Dim > 2) weight *= spline(r / reach, fraction[2 * static_cast<std::ptrdiff_t>(count) + n]);
    return weight;
  }

  /// Calls add(n, weight) for all particles that use a point, in one order.
  template <class Add>
  MESOGEN_HOST_DEVICE void around(Index point, const Add& add) const {
    const int x = point % points[0];
    const Index row = point / points[0];
    const int y = row % points[1];
    for (int r = 0; r < rows; ++r) {
      Index first = inside(1, y - r % reach);
      if constexpr (Dim > 2) first += points[1] * inside(2, row / points[1] - r / reach);
      first *= points[0];
      // The cells of a row whose particles use the point follow each other, but across the periodic face.
      const auto add_from = [&](int from, int to, int column) {
        for (Index n = begin[first + from]; n < begin[first + to]; ++n) {
          const int by = column - (cell[n] - first);
          add(n, across(r, n) * spline(by, fraction[n]));
        }
      };
      add_from(x < reach ? 0 : x - reach + 1, x + 1, x);
      if (x < reach - 1) add_from(points[0] + x - reach + 1, points[0], points[0] + x);
    }
  }

  /// The values of `Count` fields at the n-th particle. `values`: at the points, field after field.
  template <int Count>
  MESOGEN_HOST_DEVICE void interpolate(Index n, const Real* values, Real* numbers) const {
    std::ptrdiff_t all = 1;
    for (int d = 0; d < Dim; ++d) all *= points[d];
    const int x = cell[n] % points[0];
    const Index row = cell[n] / points[0];
    const int y = row % points[1];
    Real along[reach];
    int column[reach];
    exec::unroll<reach>([&](auto b) {
      along[b] = spline(b, fraction[n]);
      column[b] = inside(0, x + b);
    });
    exec::unroll<Count>([&](auto c) { numbers[c] = Real(0); });
    for (int r = 0; r < rows; ++r) {
      Index line = inside(1, y + r % reach);
      if constexpr (Dim > 2) line += points[1] * inside(2, row / points[1] + r / reach);
      const Real* const from = values + static_cast<std::ptrdiff_t>(line) * points[0];
      const Real weight = across(r, n);
      exec::unroll<Count>([&](auto c) {
        Real sum = Real(0);
        exec::unroll<reach>([&](auto b) { sum += along[b] * from[c * all + column[b]]; });
        numbers[c] += weight * sum;
      });
    }
  }
};

}  // namespace mesogen::mesh
