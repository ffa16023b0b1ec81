#pragma once

#include <array>
#include <cstddef>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::mesh {

/// A mode: its number in storage, its wave vector in 1/m, and its place in its row.
template <int Dim>
struct Mode {
  std::size_t n;
  std::array<double, Dim> k;
  int x;
};

/// The modes of KeptModes by numbers alone: for loops on a device, one thread per mode.
template <int Dim>
class ModeList {
 public:
  explicit ModeList(const KeptModes<Dim>& kept) : grid_(kept.grid()), kept_{kept.in_row()} {
    for (int d = 1; d < Dim; ++d) kept_[d] = kept.along(d);
  }

  /// Number of kept modes.
  [[nodiscard]] Index count() const {
    Index all = 1;
    for (int d = 0; d < Dim; ++d) all *= kept_[d];
    return all;
  }
  /// Number of all modes that are stored.
  [[nodiscard]] MESOGEN_HOST_DEVICE Index stored() const { return static_cast<Index>(grid_.mode_count()); }

  /// The j-th of the kept modes.
  [[nodiscard]] MESOGEN_HOST_DEVICE Mode<Dim> operator[](Index j) const {
    Mode<Dim> mode{};
    mode.x = j % kept_[0];
    mode.k[0] = grid_.wave_number(0, mode.x);
    Index rest = j / kept_[0];
    Index row = 0;
    Index rows = 1;
    for (int d = 1; d < Dim; ++d) {
      // Of the axes but the first: 0, 1, ..., and then the negative ones, which are stored last.
      const int a = rest % kept_[d];
      const int at = 2 * a < kept_[d] ? a : a + grid_.points[d] - kept_[d];
      rest /= kept_[d];
      mode.k[d] = grid_.wave_number(d, at);
      row += rows * at;
      rows *= grid_.points[d];
    }
    mode.n = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.modes_in_row()) +
             static_cast<std::size_t>(mode.x);
    return mode;
  }

  /// Finds the mode that is stored at place n. Returns whether it is kept.
  [[nodiscard]] MESOGEN_HOST_DEVICE bool find(Index n, Mode<Dim>& mode) const {
    mode.n = static_cast<std::size_t>(n);
    mode.x = n % grid_.modes_in_row();
    mode.k[0] = grid_.wave_number(0, mode.x);
    bool kept = mode.x < kept_[0];
    Index rest = n / grid_.modes_in_row();
    for (int d = 1; d < Dim; ++d) {
      const int at = rest % grid_.points[d];
      rest /= grid_.points[d];
      mode.k[d] = grid_.wave_number(d, at);
      const int waves = 2 * at <= grid_.points[d] ? at : grid_.points[d] - at;
      kept = kept && 2 * waves < kept_[d];
    }
    return kept;
  }

 private:
  Grid<Dim> grid_;
  int kept_[Dim];  // along each axis
};

}  // namespace mesogen::mesh
