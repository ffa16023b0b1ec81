#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "mesogen/mesh/four_points.hpp"
#include "mesogen/mesh/located_particles.hpp"

namespace mesogen::mesh {

/// Spreads numbers of particles to the points of a grid near them, and interpolates numbers at points to particles,
/// both with cubic B-splines.
///
/// The grid is cut into slabs, each a number of layers along the last axis. Each slab is summed by itself, and then the
/// slabs are added. The order of the additions depends only on positions and storage, so results are the same bits for
/// any number of threads.
template <int Dim>
class ParticleMesh {
  using Located = typename LocatedParticles<Dim>::Located;
  static constexpr int reach_of_rows = LocatedParticles<Dim>::reach_of_rows;
  static constexpr int reach = CubicSpline::points;
  static constexpr int last = Dim - 1;
  static constexpr int layers_in_slab = 8;

 public:
  explicit ParticleMesh(const Grid<Dim>& grid)
      : grid_(grid),
        line_(grid.points[0] + reach - 1),
        lines_in_layer_(layers_are_rows ? 1 : grid.points[1] + reach - 1),
        particles_(grid) {}

  [[nodiscard]] const Grid<Dim>& grid() const { return grid_; }
  [[nodiscard]] Index count() const { return particles_.count(); }

  /// As LocatedParticles::locate.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    particles_.locate(position, count, origin);
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
      for (Index n = begin_of_layer(first); n < begin_of_layer(end); ++n)
        add<Count>(particles_[n], first, value, slab, field);
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
      for (Index n = particles_.begin_of_row(row); n < particles_.begin_of_row(row + 1); ++n) {
        const Located& where = particles_[n];
        double numbers[Count];
        const FourPoints along = load(where.weight[0]);
        FourPoints sums[Count];
        for (int c = 0; c < Count; ++c) sums[c] = FourPoints(0.0);
        for (int r = 0; r < reach_of_rows; ++r) {
          const FourPoints weight = along * FourPoints(where.across(r));
          const double* const values = line[r] + where.column;
          for (int c = 0; c < Count; ++c) sums[c] = sums[c] + weight * load(values + c * field);
        }
        for (int c = 0; c < Count; ++c) numbers[c] = sum(sums[c]);
        take(where.particle, numbers);
      }
    }
  }

 private:
  static constexpr bool layers_are_rows = last == 1;

  [[nodiscard]] Index begin_of_layer(int layer) const {
    return particles_.begin_of_row(layer * (layers_are_rows ? 1 : grid_.points[1]));
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
      const FourPoints weight = along * FourPoints(where.across(r));
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
  LocatedParticles<Dim> particles_;
  std::vector<double> slab_;
  std::vector<double> lines_;
};

}  // namespace mesogen::mesh
