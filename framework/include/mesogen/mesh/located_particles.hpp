#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Particles sorted by the row of grid cells in which they are, with their places there. Particles of one row stay in
/// the order of storage: near each other in memory, and the same for any number of threads.
template <int Dim, class Real>
class LocatedParticles {
  static_assert(Dim > 1 && Dim <= 3);
  static constexpr int last = Dim - 1;

 public:
  struct Located {
    Index particle;
    int column;          // of the point below its cell, along the first axis
    Real fraction[Dim];  // position in the cell, 0 to 1
  };

  explicit LocatedParticles(const Grid<Dim>& grid)
      : grid_(grid), begin_(static_cast<std::size_t>(grid.row_count()) + 1) {
    for (int d = 0; d < Dim; ++d) cells_per_length_[d] = 1.0 / grid.spacing(d);
  }

  [[nodiscard]] Index count() const { return static_cast<Index>(located_.size()); }
  /// The n-th in the order of rows.
  [[nodiscard]] const Located& operator[](Index n) const { return located_[static_cast<std::size_t>(n)]; }
  /// The first whose points begin in this row (numbered as by Grid::row_coordinates) or a later one.
  [[nodiscard]] Index begin_of_row(int row) const { return begin_[static_cast<std::size_t>(row)]; }

  /// Takes the positions of the particles, m. Of a particle outside the box, its periodic image inside is used.
  /// `origin`: position of the first point of the grid, m. All positions must be finite.
  ///
  /// This is a counting sort. Each thread counts and moves particles that are contiguous in storage.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    origin_ = origin;
    located_.resize(static_cast<std::size_t>(count));
    row_of_.resize(located_.size());
    const auto rows = static_cast<std::size_t>(grid_.row_count());
#pragma omp parallel
    {
      const auto thread = static_cast<std::size_t>(omp_get_thread_num());
#pragma omp single
      next_.resize(static_cast<std::size_t>(omp_get_num_threads()));
      std::vector<Index>& own = next_[thread];
      // Counted in turns in two places: neighbours in storage are mostly of one row, and the processor would wait for
      // one count to be stored before it can load it for the next.
      own.assign(2 * rows, 0);
#pragma omp for schedule(static)
      for (Index i = 0; i < count; ++i) {
        int row = 0;
        for (int d = last; d > 0; --d)
          row = row * grid_.points[d] + first_point(d, std::floor(in_cells(d, position[d][i])));
        row_of_[static_cast<std::size_t>(i)] = row;
        ++own[2 * static_cast<std::size_t>(row) + static_cast<std::size_t>(i % 2)];
      }
#pragma omp single
      {
        Index total = 0;
        for (std::size_t row = 0; row < rows; ++row) {
          begin_[row] = total;
          for (auto& of_thread : next_) {
            const Index of_row = of_thread[2 * row] + of_thread[2 * row + 1];
            of_thread[2 * row] = total;
            total += of_row;
          }
        }
        begin_[rows] = total;
      }
#pragma omp for schedule(static)
      for (Index i = 0; i < count; ++i) {
        const Index to = own[2 * static_cast<std::size_t>(row_of_[static_cast<std::size_t>(i)])]++;
        located_[static_cast<std::size_t>(to)] = place(position, i);
      }
    }
  }

 private:
  /// Distance of a coordinate from the origin, in cells.
  [[nodiscard]] double in_cells(int d, double x) const { return (x - origin_[d]) * cells_per_length_[d]; }

  /// The first of the four points that a coordinate uses along an axis: the one below its cell.
  [[nodiscard]] int first_point(int d, double cell) const {
    const std::int64_t points = grid_.points[d];
    std::int64_t first = static_cast<std::int64_t>(cell) - 1;
    if (first < 0) first += points;  // division takes long, and hardly a particle is more than one box away
    if (first < 0 || first >= points) first = (first % points + points) % points;
    return static_cast<int>(first);
  }

  [[nodiscard]] Located place(const std::array<const double*, Dim>& position, Index i) const {
    Located where{};
    where.particle = i;
    for (int d = 0; d < Dim; ++d) {
      const double x = in_cells(d, position[d][i]);
      const double cell = std::floor(x);
      where.fraction[d] = static_cast<Real>(x - cell);
      if (d == 0) where.column = first_point(d, cell);
    }
    return where;
  }

  Grid<Dim> grid_;
  std::array<double, Dim> cells_per_length_{};
  std::array<double, Dim> origin_{};
  std::vector<Located> located_;          // by row
  std::vector<int> row_of_;               // by particle
  std::vector<std::vector<Index>> next_;  // by thread, at twice the row: place of its next particle
  std::vector<Index> begin_;              // of each row's particles in located_, and one more
};

}  // namespace mesogen::mesh
