#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesogen/fields/field_view.hpp"
#include "mesogen/mesh/cubic_spline.hpp"
#include "mesogen/mesh/four_points.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Spreads numbers of particles to the points of a grid near them, and interpolates numbers at points to particles,
/// both with cubic B-splines.
///
/// Particles are sorted by the grid cell in which they are. The grid is cut into slabs, each a number of layers along
/// the last axis. Each slab is summed by itself, and then the slabs are added. The order of the additions depends only
/// on positions and storage, so results are the same bits for any number of threads.
template <int Dim>
class ParticleMesh {
  static_assert(Dim > 1 && Dim <= 3);
  static constexpr int reach = CubicSpline::points;
  static constexpr int last = Dim - 1;
  static constexpr int layers_in_slab = 8;

 public:
  explicit ParticleMesh(const Grid<Dim>& grid)
      : grid_(grid),
        line_(grid.points[0] + reach - 1),
        lines_in_layer_(layers_are_rows ? 1 : grid.points[1] + reach - 1),
        begin_(static_cast<std::size_t>(grid.row_count()) + 1) {
    for (int d = 0; d < Dim; ++d) cells_per_length_[d] = 1.0 / grid.spacing(d);
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return grid_; }
  [[nodiscard]] Index count() const { return static_cast<Index>(located_.size()); }

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

  /// Sets out[c](x) = sum over particles of weight(x - x_i) value_c(i). value(i, numbers) must write the `Count`
  /// numbers of particle i.
  template <int Count, class Value>
  void spread(const Value& value, const std::array<double*, Count>& out) {
    const int layers = grid_.points[last];
    const int slabs = (layers + layers_in_slab - 1) / layers_in_slab;
    const std::ptrdiff_t layer = static_cast<std::ptrdiff_t>(line_) * lines_in_layer_;
    const std::ptrdiff_t field = layer * (layers_in_slab + reach - 1);
    slab_.resize(static_cast<std::size_t>(field * Count * slabs));
#pragma omp parallel for schedule(static)
    for (int s = 0; s < slabs; ++s) {
      double* const slab = slab_.data() + s * field * Count;
      std::fill(slab, slab + field * Count, 0.0);
      const int first = s * layers_in_slab;
      const int end = std::min(layers, first + layers_in_slab);
      for (Index n = begin_of_layer(first); n < begin_of_layer(end); ++n) add<Count>(at(n), first, value, slab, field);
    }
#pragma omp parallel for schedule(static) if (grid_.point_count() >= parallel_threshold)
    for (int row = 0; row < grid_.row_count(); ++row) put_together<Count>(row, field, layer, out);
  }

  /// Calls take(i, numbers) for every particle, with the values that the `Count` fields on the grid have there.
  template <int Count, class Take>
  void gather(const std::array<const double*, Count>& from, const Take& take) {
    const int columns = grid_.points[0];
    const int rows = grid_.row_count();
    // Each row is followed by a copy of its first points.
    const std::ptrdiff_t field = static_cast<std::ptrdiff_t>(line_) * rows;
    lines_.resize(static_cast<std::size_t>(field * Count));
#pragma omp parallel for schedule(static) if (grid_.point_count() >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      for (int c = 0; c < Count; ++c) {
        double* const line = lines_.data() + c * field + static_cast<std::ptrdiff_t>(row) * line_;
        const double* const values = from[c] + static_cast<std::ptrdiff_t>(row) * columns;
        std::copy(values, values + columns, line);
        std::copy(values, values + reach - 1, line + columns);
      }
    }
#pragma omp parallel for schedule(static)
    for (int row = 0; row < rows; ++row) {
      const double* line[reach_of_rows];
      rows_above(row, line);
      for (Index n = begin_[static_cast<std::size_t>(row)]; n < begin_[static_cast<std::size_t>(row) + 1]; ++n) {
        const Located& where = at(n);
        double numbers[Count];
        const FourPoints along = load(where.weight[0]);
        FourPoints sums[Count];
        for (int c = 0; c < Count; ++c) sums[c] = FourPoints(0.0);
        for (int r = 0; r < reach_of_rows; ++r) {
          const FourPoints weight = along * FourPoints(across(where, r));
          const double* const values = line[r] + where.column;
          for (int c = 0; c < Count; ++c) sums[c] = sums[c] + weight * load(values + c * field);
        }
        for (int c = 0; c < Count; ++c) numbers[c] = sum(sums[c]);
        take(where.particle, numbers);
      }
    }
  }

 private:
  /// Rows that a particle uses: `reach` along each axis but the first.
  static constexpr int reach_of_rows = [] {
    int rows = 1;
    for (int d = 1; d < Dim; ++d) rows *= reach;
    return rows;
  }();
  static constexpr bool layers_are_rows = last == 1;

  struct Located {
    Index particle;
    int column;                 // of the first point that it uses, along the first axis
    int row;                    // the same along the other axes, numbered as by Grid::row_coordinates
    double weight[Dim][reach];  // of the points from the first on
  };

  struct InRow {
    Index particle;
    int column;
  };

  /// Weight of the r-th row that a particle uses.
  [[gnu::always_inline]] static double across(const Located& where, int r) {
    double weight = where.weight[1][r % reach];
    if constexpr (!layers_are_rows) weight *= where.weight[last][r / reach];
    return weight;
  }

  [[nodiscard]] const Located& at(Index n) const { return located_[static_cast<std::size_t>(n)]; }
  [[nodiscard]] Index begin_of_layer(int layer) const {
    return begin_[static_cast<std::size_t>(layer * (layers_are_rows ? 1 : grid_.points[1]))];
  }

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

  template <int Count, class Value>
  void add(const Located& where, int first_layer, const Value& value, double* slab, std::ptrdiff_t field) const {
    double numbers[Count];
    value(where.particle, numbers);
    int line = where.row - first_layer;
    if constexpr (!layers_are_rows)
      line = (where.row / grid_.points[1] - first_layer) * lines_in_layer_ + where.row % grid_.points[1];
    double* const to = slab + static_cast<std::ptrdiff_t>(line) * line_ + where.column;
    const FourPoints along = load(where.weight[0]);
    for (int r = 0; r < reach_of_rows; ++r) {
      const FourPoints weight = along * FourPoints(across(where, r));
      std::ptrdiff_t down = r % reach;
      if constexpr (!layers_are_rows) down += static_cast<std::ptrdiff_t>(r / reach) * lines_in_layer_;
      double* const points = to + down * line_;
      for (int c = 0; c < Count; ++c)
        store(load(points + c * field) + weight * FourPoints(numbers[c]), points + c * field);
    }
  }

  // Adds one row of points from all slabs whose particles reach it, also across the periodic face. Values stored beyond
  // the last point of a line or of a layer belong to the first points.
  template <int Count>
  void put_together(int row, std::ptrdiff_t field, std::ptrdiff_t layer, const std::array<double*, Count>& out) const {
    std::array<int, Dim> at_row{};
    grid_.row_coordinates(row, at_row);
    const int columns = grid_.points[0];
    const int layers = grid_.points[last];
    const auto take = [&](double* to, const double* from, bool begin) {
      for (int x = 0; x < columns; ++x) to[x] = begin ? from[x] : to[x] + from[x];
      for (int x = 0; x < reach - 1; ++x) to[x] += from[columns + x];
    };
    for (int c = 0; c < Count; ++c) {
      double* const to = out[c] + static_cast<std::ptrdiff_t>(row) * columns;
      bool begin = true;
      const auto from_slab = [&](int slab, int depth) {
        const double* const from = slab_.data() + (slab * Count + c) * field + depth * layer;
        if constexpr (layers_are_rows) {
          take(to, from, begin);
        } else {
          take(to, from + static_cast<std::ptrdiff_t>(at_row[1]) * line_, begin);
          if (at_row[1] < reach - 1)
            take(to, from + static_cast<std::ptrdiff_t>(at_row[1] + grid_.points[1]) * line_, false);
        }
        begin = false;
      };
      int slab = -1;
      int depth = -1;
      for (int by = 0; by < reach; ++by) {
        const int source = (at_row[last] - by + layers) % layers;
        const int of = source / layers_in_slab;
        const int at_depth = source % layers_in_slab + by;
        if (of == slab && at_depth == depth) continue;
        slab = of;
        depth = at_depth;
        from_slab(slab, depth);
      }
    }
  }

  /// The rows of lines_ that particles of a row use, the second axis fastest.
  void rows_above(int row, const double* (&line)[reach_of_rows]) const {
    std::array<int, Dim> at_row{};
    grid_.row_coordinates(row, at_row);
    const auto upper = [&](int d, int by) { return (at_row[d] + by) % grid_.points[d]; };
    for (int r = 0; r < reach_of_rows; ++r) {
      int above = upper(1, r % reach);
      if constexpr (!layers_are_rows) above += grid_.points[1] * upper(last, r / reach);
      line[r] = lines_.data() + static_cast<std::ptrdiff_t>(above) * line_;
    }
  }

  Grid<Dim> grid_;
  int line_;            // points in a row, and those stored beyond its end
  int lines_in_layer_;  // the same for lines
  std::array<double, Dim> cells_per_length_{};
  std::array<double, Dim> origin_{};
  std::vector<Located> located_;  // by cell
  std::vector<InRow> in_row_;     // by row, then in the order of storage
  std::vector<int> row_of_;
  std::vector<Index> begin_;  // of each row's particles in located_, and one more
  std::vector<double> slab_;
  std::vector<double> lines_;
};

}  // namespace mesogen::mesh
