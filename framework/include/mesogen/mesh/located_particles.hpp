#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/cubic_spline.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Particles sorted by the grid cell in which they are, with the points of the grid near them and the weights of cubic
/// B-splines there. The order depends only on positions and storage, not on the number of threads.
template <int Dim>
class LocatedParticles {
  static_assert(Dim > 1 && Dim <= 3);
  static constexpr int reach = CubicSpline::points;
  static constexpr int last = Dim - 1;

 public:
  /// Rows that a particle uses: `reach` along each axis but the first.
  static constexpr int reach_of_rows = [] {
    int rows = 1;
    for (int d = 1; d < Dim; ++d) rows *= reach;
    return rows;
  }();

  struct Located {
    Index particle;
    int column;                 // of the first point that it uses, along the first axis
    int row;                    // the same along the other axes, numbered as by Grid::row_coordinates
    double weight[Dim][reach];  // of the points from the first on

    /// Weight of the r-th row.
    [[gnu::always_inline]] [[nodiscard]] double across(int r) const {
      double product = weight[1][r % reach];
      if constexpr (Dim > 2) product *= weight[last][r / reach];
      return product;
    }
  };

  explicit LocatedParticles(const Grid<Dim>& grid)
      : grid_(grid), begin_(static_cast<std::size_t>(grid.row_count()) + 1) {
    for (int d = 0; d < Dim; ++d) cells_per_length_[d] = 1.0 / grid.spacing(d);
  }

  [[nodiscard]] Index count() const { return static_cast<Index>(located_.size()); }
  /// The n-th in the order of cells.
  [[nodiscard]] const Located& operator[](Index n) const { return located_[static_cast<std::size_t>(n)]; }
  /// The first whose points begin in this row or a later one.
  [[nodiscard]] Index begin_of_row(int row) const { return begin_[static_cast<std::size_t>(row)]; }

  /// Takes the positions of the particles, m. Of a particle outside the box, its periodic image inside is used.
  /// `origin`: position of the first point of the grid, m. All positions must be finite.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    origin_ = origin;
    located_.resize(static_cast<std::size_t>(count));
    row_of_.resize(located_.size());
    in_row_.resize(located_.size());
    sort_by_row(position, count);
    place_rows(position);
  }

 private:
  struct InRow {
    Index particle;
    int column;
  };

  /// Distance of a coordinate from the origin, in cells.
  [[nodiscard]] double in_cells(int d, double x) const { return (x - origin_[d]) * cells_per_length_[d]; }

  /// The first of the four points that a coordinate uses along an axis: the one below its cell.
  [[nodiscard]] int first_point(int d, double cell) const {
    if (cell >= 1.0 && cell <= grid_.points[d]) return static_cast<int>(cell) - 1;
    const std::int64_t points = grid_.points[d];
    const std::int64_t first = (static_cast<std::int64_t>(cell) - 1) % points;
    return static_cast<int>(first < 0 ? first + points : first);
  }

  [[nodiscard]] Located place(const std::array<const double*, Dim>& position, Index i) const {
    Located where{};
    where.particle = i;
    for (int d = last; d >= 0; --d) {
      const double x = in_cells(d, position[d][i]);
      const double cell = std::floor(x);
      CubicSpline::weights(x - cell, where.weight[d]);
      if (d == 0) {
        where.column = first_point(d, cell);
      } else {
        where.row = where.row * grid_.points[d] + first_point(d, cell);
      }
    }
    return where;
  }

  // A counting sort. Each thread counts and moves particles that are contiguous in storage. Therefore particles of one
  // row stay in the order of storage, whatever the number of threads.
  void sort_by_row(const std::array<const double*, Dim>& position, Index count) {
    const auto rows = static_cast<std::size_t>(grid_.row_count());
    std::vector<std::vector<Index>> next;  // by thread and row: place of its next particle
#pragma omp parallel
    {
      const auto thread = static_cast<std::size_t>(omp_get_thread_num());
#pragma omp single
      next.assign(static_cast<std::size_t>(omp_get_num_threads()), std::vector<Index>(rows, 0));
      auto& own = next[thread];
#pragma omp for schedule(static)
      for (Index i = 0; i < count; ++i) {
        int row = 0;
        for (int d = last; d > 0; --d)
          row = row * grid_.points[d] + first_point(d, std::floor(in_cells(d, position[d][i])));
        row_of_[static_cast<std::size_t>(i)] = row;
        ++own[static_cast<std::size_t>(row)];
      }
#pragma omp single
      {
        Index total = 0;
        for (std::size_t row = 0; row < rows; ++row) {
          begin_[row] = total;
          for (auto& of_thread : next) total += std::exchange(of_thread[row], total);
        }
        begin_[rows] = total;
      }
#pragma omp for schedule(static)
      for (Index i = 0; i < count; ++i) {
        const Index to = own[static_cast<std::size_t>(row_of_[static_cast<std::size_t>(i)])]++;
        in_row_[static_cast<std::size_t>(to)] = {i, first_point(0, std::floor(in_cells(0, position[0][i])))};
      }
    }
  }

  // A counting sort by column within each row. Particles of one column stay in the order of storage.
  void place_rows(const std::array<const double*, Dim>& position) {
    const int rows = grid_.row_count();
#pragma omp parallel
    {
      std::vector<Index> next(static_cast<std::size_t>(grid_.points[0]) + 1);
#pragma omp for schedule(static)
      for (int row = 0; row < rows; ++row) {
        const Index begin = begin_[static_cast<std::size_t>(row)];
        const Index end = begin_[static_cast<std::size_t>(row) + 1];
        std::fill(next.begin(), next.end(), 0);
        for (Index n = begin; n < end; ++n)
          ++next[static_cast<std::size_t>(in_row_[static_cast<std::size_t>(n)].column) + 1];
        for (std::size_t column = 1; column < next.size(); ++column) next[column] += next[column - 1];
        for (Index n = begin; n < end; ++n) {
          const InRow& one = in_row_[static_cast<std::size_t>(n)];
          const Index to = begin + next[static_cast<std::size_t>(one.column)]++;
          located_[static_cast<std::size_t>(to)] = place(position, one.particle);
        }
      }
    }
  }

  Grid<Dim> grid_;
  std::array<double, Dim> cells_per_length_{};
  std::array<double, Dim> origin_{};
  std::vector<Located> located_;  // by cell
  std::vector<InRow> in_row_;     // by row, then in the order of storage
  std::vector<int> row_of_;
  std::vector<Index> begin_;  // of each row's particles in located_, and one more
};

}  // namespace mesogen::mesh
