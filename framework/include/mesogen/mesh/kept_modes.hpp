#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mesogen/mesh/complex.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// The Fourier modes on a grid up to a cutoff: two thirds of the largest wave number of the grid along each axis. All
/// others are zero, so a product of two fields has no aliased modes. Modes are numbered as they are stored: rows along
/// the first axis, each of Grid::modes_in_row() modes, those beyond the cutoff among them.
template <int Dim>
class KeptModes {
 public:
  using WaveVector = std::array<double, Dim>;

  explicit KeptModes(const Grid<Dim>& grid)
      : grid_(grid), in_row_(number_below(0)), of_row_(static_cast<std::size_t>(grid.row_count())) {
    for (int row = 0; row < grid.row_count(); ++row) {
      std::array<int, Dim> at{};
      grid.row_coordinates(row, at);
      bool kept = true;
      for (int d = 1; d < Dim; ++d) kept = kept && is_kept(d, at[d]);
      if (!kept) continue;
      of_row_[static_cast<std::size_t>(row)] = true;
      rows_.push_back(row);
    }
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return grid_; }
  [[nodiscard]] double cutoff(int axis) const { return 2.0 / 3.0 * grid_.highest(axis); }
  /// Number of modes that are stored.
  [[nodiscard]] std::size_t mode_count() const { return grid_.mode_count(); }
  /// Number of modes that are kept of a row: the first ones, or none.
  [[nodiscard]] int in_row(int row) const { return of_row_[static_cast<std::size_t>(row)] ? in_row_ : 0; }
  /// The largest of these numbers.
  [[nodiscard]] int in_row() const { return in_row_; }
  /// Number of modes that are kept along an axis: of the first axis half of them, as all others follow.
  [[nodiscard]] int along(int axis) const { return axis == 0 ? in_row_ : 2 * number_below(axis) - 1; }

  MESOGEN_HOST_DEVICE static double square(const WaveVector& k) {
    double sum = 0.0;
    for (int d = 0; d < Dim; ++d) sum += k[d] * k[d];
    return sum;
  }

  /// Calls action(n, k, x) for the kept modes of a row: the number of the mode, its wave vector, its place in the row.
  template <class Action>
  void for_each_in_row(int row, const Action& action) const {
    std::array<int, Dim> at{};
    grid_.row_coordinates(row, at);
    WaveVector k{};
    for (int d = 1; d < Dim; ++d) k[d] = grid_.wave_number(d, at[d]);
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.modes_in_row());
    const int kept = in_row(row);
    for (int x = 0; x < kept; ++x) {
      k[0] = grid_.wave_number(0, x);
      action(first + static_cast<std::size_t>(x), k, x);
    }
  }

  /// Calls action(n, k) for all kept modes, in parallel. No function that is called in parallel here may throw.
  template <class Action>
  void for_each(const Action& action) const {
    const auto rows = static_cast<int>(rows_.size());
#pragma omp parallel for schedule(static) if (rows * in_row_ >= parallel_threshold)
    for (int r = 0; r < rows; ++r)
      for_each_in_row(rows_[static_cast<std::size_t>(r)],
                      [&](std::size_t n, const WaveVector& k, int) { action(n, k); });
  }

  /// Adds up row by row, then the sums of the rows: in one order for any number of threads. term(n, k, x, sum) must add
  /// to `sum` what belongs to a mode.
  template <class Term>
  [[nodiscard]] double sum(const Term& term) const {
    const int rows = grid_.row_count();
    std::vector<double> of_row(static_cast<std::size_t>(rows));
#pragma omp parallel for schedule(static) if (rows * in_row_ >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      double sum = 0.0;
      for_each_in_row(row, [&](std::size_t n, const WaveVector& k, int x) { term(n, k, x, sum); });
      of_row[static_cast<std::size_t>(row)] = sum;
    }
    double total = 0.0;
    for (const double sum : of_row) total += sum;
    return total;
  }

 private:
  // How many of the modes 0, 1, ... along an axis are kept.
  [[nodiscard]] int number_below(int axis) const {
    int n = 0;
    while (2 * n <= grid_.points[axis] && is_kept(axis, n)) ++n;
    return n;
  }
  [[nodiscard]] bool is_kept(int axis, int n) const {
    return std::abs(grid_.wave_number(axis, n)) <= cutoff(axis) * (1.0 + 1e-12);
  }

  Grid<Dim> grid_;
  int in_row_;
  std::vector<bool> of_row_;  // whether any mode of a row is kept
  std::vector<int> rows_;     // those of which modes are kept
};

}  // namespace mesogen::mesh
