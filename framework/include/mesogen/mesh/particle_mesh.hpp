#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesogen/exec/sharing.hpp"
#include "mesogen/mesh/cubic_spline.hpp"
#include "mesogen/mesh/fields_on_grid.hpp"
#include "mesogen/mesh/located_particles.hpp"

namespace mesogen::mesh {

/// Spreads numbers of particles to the points of a grid near them, and interpolates numbers at points to particles,
/// both with cubic B-splines. `Real` is the precision of the numbers and of the weights.
///
/// The grid is cut into slabs, each a number of layers along the last axis. Each slab is summed by itself, and then the
/// slabs are added. The order of the additions depends only on positions and storage, so results are the same bits for
/// any number of threads.
template <int Dim, class Real = double>
class ParticleMesh {
  using Located = typename LocatedParticles<Dim, Real>::Located;
  static constexpr int reach = CubicSpline::points;
  static constexpr int last = Dim - 1;
  static constexpr int layers_in_slab = 8;
  static constexpr Index parts_of_row = 8;
  /// Rows that a particle uses: `reach` along each axis but the first.
  static constexpr int reach_of_rows = Dim > 2 ? reach* reach : reach;

 public:
  using Fields = FieldsOnGrid<Real>;

  /// `sharing`: the processes that share the particles. What they spread is added up on each; null: there is this one.
  explicit ParticleMesh(const Grid<Dim>& grid, const exec::Sharing* sharing = nullptr)
      : grid_(grid),
        sharing_(sharing),
        line_(grid.points[0] + reach - 1),
        lines_in_layer_(layers_are_rows ? 1 : grid.points[1] + reach - 1),
        particles_(grid) {}

  /// Approximate memory, in bytes, for so many particles, of which `spread` numbers each are spread at a time and
  /// `gathered` are interpolated.
  static double bytes(const Grid<Dim>& grid, Index particles, int spread, int gathered) {
    constexpr double in_slabs = static_cast<double>(layers_in_slab + reach - 1) / layers_in_slab;
    const auto side_by_side = [](int fields) { return std::bit_ceil(static_cast<unsigned>(fields)); };
    return FieldsOnGrid<Real>::bytes(grid) * (in_slabs * side_by_side(spread) + side_by_side(gathered)) +
           static_cast<double>(particles) * static_cast<double>(sizeof(Located) + sizeof(int));
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return grid_; }
  [[nodiscard]] Index count() const { return particles_.count(); }
  /// Particles of all processes.
  [[nodiscard]] std::int64_t total() const {
    std::int64_t number = count();
    if (sharing_ != nullptr) sharing_->add(std::span(&number, 1));
    return number;
  }

  /// As LocatedParticles::locate.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    particles_.locate(position, count, origin);
  }

  /// Sets the first `Count` fields: out(c, x) = sum over particles of weight(x - x_i) value_c(i). value(i, numbers)
  /// must write the `Count` numbers of particle i. finish(row) is called for every row of the grid when it is complete,
  /// in parallel.
  template <int Count, class Value, class Finish>
  void spread(const Value& value, Fields& out, const Finish& finish) {
    sum_slabs<Count, false>(value);
    put_together_of_all<Count>(out, finish);
  }
  template <int Count, class Value>
  void spread(const Value& value, Fields& out) {
    spread<Count>(value, out, [](int) {});
  }

  /// Replaces the first `Count` fields by what they miss at the particles: as spread(), of value(i, numbers) minus what
  /// the fields have at particle i.
  template <int Count, class Value, class Finish>
  void spread_missing(const Value& value, Fields& fields, const Finish& finish) {
    interleave<Count>(fields);
    sum_slabs<Count, true>(value);
    put_together_of_all<Count>(fields, finish);
  }

  /// Calls take(i, numbers) for every particle, with the values that the first `Count` fields have there.
  template <int Count, class Take>
  void gather(const Fields& fields, const Take& take) {
    interleave<Count>(fields);
#pragma omp parallel for schedule(static)
    for (int row = 0; row < grid_.row_count(); ++row) {
      const From from = rows_above(row, width<Count>);
      for (Index n = particles_.begin_of_row(row); n < particles_.begin_of_row(row + 1); ++n) {
        Real numbers[width<Count>];
        interpolate(Weights<width<Count>>(particles_[n]), from, numbers);
        take(particles_[n].particle, numbers);
      }
    }
  }

 private:
  static constexpr bool layers_are_rows = last == 1;
  /// The rows of lines_ that particles of a row use, the second axis fastest.
  using From = std::array<const Real*, reach_of_rows>;

  /// Fields that are stored point by point, so that a pack holds some of them at all four points. There is room for as
  /// many as a power of 2.
  template <int Count>
  static constexpr int width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(Count)));

  /// The points that a particle uses: the first, and weights along the first axis and of the rows.
  template <int Width>
  struct Weights {
    std::ptrdiff_t column;
    FourPoints<Real, Width> along;
    Real across[reach_of_rows];

    [[gnu::always_inline]] explicit Weights(const Located& where)
        : column(where.column), along(CubicSpline::weights<Width>(where.fraction[0])) {
      Real of_second[reach];
      store(CubicSpline::weights<1>(where.fraction[1]), of_second);
      Real of_last[reach];
      if constexpr (Dim > 2) store(CubicSpline::weights<1>(where.fraction[last]), of_last);
      for (int r = 0; r < reach_of_rows; ++r) {
        across[r] = of_second[r % reach];
        if constexpr (Dim > 2) across[r] *= of_last[r / reach];
      }
    }
  };

  template <int Width>
  [[gnu::always_inline]] static void interpolate(const Weights<Width>& weights, const From& from, Real* numbers) {
    using Pack = FourPoints<Real, Width>;
    Pack sum(Real(0));
    for (int r = 0; r < reach_of_rows; ++r) {
      const auto points = load<Pack>(from[static_cast<std::size_t>(r)] + weights.column * Width);
      sum = sum + weights.along * points * Pack(weights.across[r]);
    }
    add_points<Width>(sum, numbers);
  }

  [[nodiscard]] int rows_in_layer() const { return layers_are_rows ? 1 : grid_.points[1]; }
  [[nodiscard]] std::ptrdiff_t points_in_layer() const { return static_cast<std::ptrdiff_t>(line_) * lines_in_layer_; }
  [[nodiscard]] std::ptrdiff_t points_in_slab() const { return points_in_layer() * (layers_in_slab + reach - 1); }
  static void make_room(std::vector<Real>& numbers, std::ptrdiff_t count) {
    if (static_cast<std::ptrdiff_t>(numbers.size()) < count) numbers.resize(static_cast<std::size_t>(count));
  }

  /// Puts the first `Count` fields side by side into lines_. After each row its first points follow once more.
  template <int Count>
  void interleave(const Fields& fields) {
    constexpr int apart = width<Count>;
    const int rows = grid_.row_count();
    const int columns = grid_.points[0];
    make_room(lines_, static_cast<std::ptrdiff_t>(line_) * rows * apart);
#pragma omp parallel for schedule(static) if (grid_.point_count() >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      Real* const line = lines_.data() + static_cast<std::ptrdiff_t>(row) * line_ * apart;
      for (int c = 0; c < Count; ++c) {
        const Real* const values = fields.row(c, row);
        for (int x = 0; x < columns; ++x) line[x * apart + c] = values[x];
      }
      std::copy_n(line, (reach - 1) * apart, line + columns * apart);
    }
  }

  // Sums up slabs; if `Missing`, of value(i, numbers) minus what lines_ have at particle i.
  template <int Count, bool Missing, class Value>
  void sum_slabs(const Value& value) {
    constexpr int fields = width<Count>;
    const int layers = grid_.points[last];
    const int slabs = (layers + layers_in_slab - 1) / layers_in_slab;
    const std::ptrdiff_t numbers_in_slab = points_in_slab() * fields;
    make_room(slab_, numbers_in_slab * slabs);
#pragma omp parallel for schedule(static)
    for (int s = 0; s < slabs; ++s) {
      Real* const slab = slab_.data() + s * numbers_in_slab;
      std::fill(slab, slab + numbers_in_slab, Real(0));
      const int first = s * layers_in_slab;
      const int end = std::min(layers, first + layers_in_slab);
      for (int row = first * rows_in_layer(); row < end * rows_in_layer(); ++row) {
        const From from = rows_above(row, fields);
        const int line = (row / rows_in_layer() - first) * lines_in_layer_ + row % rows_in_layer();
        Real* const to = slab + static_cast<std::ptrdiff_t>(line) * line_ * fields;
        std::ptrdiff_t down[reach_of_rows];
        for (int r = 0; r < reach_of_rows; ++r)
          down[r] = static_cast<std::ptrdiff_t>(r % reach + r / reach * lines_in_layer_) * line_ * fields;
        // Neighbours in storage mostly add to the same points, and the processor would wait for one to be stored before
        // it can load the next: so some others come in between.
        const Index begin = particles_.begin_of_row(row);
        const Index count = particles_.begin_of_row(row + 1) - begin;
        const Index part = (count + parts_of_row - 1) / parts_of_row;
        for (Index in_part = 0; in_part < part; ++in_part)
          for (Index n = in_part; n < count; n += part)
            add<Count, Missing>(particles_[begin + n], from, value, to, down);
      }
    }
  }

  template <int Count, bool Missing, class Value>
  [[gnu::always_inline]] static void add(const Located& where, const From& from, const Value& value, Real* to,
                                         const std::ptrdiff_t (&down)[reach_of_rows]) {
    constexpr int fields = width<Count>;
    using Pack = FourPoints<Real, fields>;
    const Weights<fields> weights(where);
    Real numbers[fields] = {};
    value(where.particle, numbers);
    if constexpr (Missing) {
      Real there[fields];
      interpolate(weights, from, there);
      for (int c = 0; c < Count; ++c) numbers[c] -= there[c];
    }
    const Pack along = weights.along * at_each_point<fields>(numbers);
    for (int r = 0; r < reach_of_rows; ++r) {
      Real* const points = to + down[r] + weights.column * fields;
      store(load<Pack>(points) + along * Pack(weights.across[r]), points);
    }
  }

  template <int Count, class Finish>
  void put_together_of_all(Fields& out, const Finish& finish) const {
    if (sharing_ == nullptr) return put_together<Count>(out, finish);
    put_together<Count>(out, [](int) {});
    sharing_->add(std::span(out.row(0, 0), static_cast<std::size_t>(Count * out.field_stride())));
#pragma omp parallel for schedule(static) if (grid_.point_count() >= parallel_threshold)
    for (int row = 0; row < grid_.row_count(); ++row) finish(row);
  }

  // Adds each row of points from all slabs whose particles reach it, also across the periodic face. Values stored
  // beyond the last point of a line or of a layer belong to the first points.
  template <int Count, class Finish>
  void put_together(Fields& out, const Finish& finish) const {
    constexpr int apart = width<Count>;
    const int columns = grid_.points[0];
#pragma omp parallel for schedule(static) if (grid_.point_count() >= parallel_threshold)
    for (int row = 0; row < grid_.row_count(); ++row) {
      for (int c = 0; c < Count; ++c) std::fill_n(out.row(c, row), columns, Real(0));
      for_each_source(row, [&](std::ptrdiff_t first_point) {
        const Real* const from = slab_.data() + first_point * apart;
        for (int c = 0; c < Count; ++c) {
          Real* const to = out.row(c, row);
          for (int x = 0; x < columns; ++x) to[x] += from[x * apart + c];
          for (int x = 0; x < reach - 1; ++x) to[x] += from[(columns + x) * apart + c];
        }
      });
      finish(row);
    }
  }

  // Calls action with the first point of every line in slab_ that belongs to a row of the grid.
  template <class Action>
  void for_each_source(int row, const Action& action) const {
    std::array<int, Dim> at_row{};
    grid_.row_coordinates(row, at_row);
    const int layers = grid_.points[last];
    std::ptrdiff_t before = -1;
    for (int by = 0; by < reach; ++by) {
      const int source = (at_row[last] - by + layers) % layers;
      const std::ptrdiff_t layer =
          source / layers_in_slab * points_in_slab() + (source % layers_in_slab + by) * points_in_layer();
      if (layer == before) continue;
      before = layer;
      if constexpr (layers_are_rows) {
        action(layer);
      } else {
        action(layer + static_cast<std::ptrdiff_t>(at_row[1]) * line_);
        if (at_row[1] < reach - 1) action(layer + static_cast<std::ptrdiff_t>(at_row[1] + grid_.points[1]) * line_);
      }
    }
  }

  [[nodiscard]] From rows_above(int row, int apart) const {
    std::array<int, Dim> at_row{};
    grid_.row_coordinates(row, at_row);
    const auto upper = [&](int d, int by) { return (at_row[d] + by) % grid_.points[d]; };
    From rows{};
    if (lines_.empty()) return rows;
    for (int r = 0; r < reach_of_rows; ++r) {
      int above = upper(1, r % reach);
      if constexpr (!layers_are_rows) above += grid_.points[1] * upper(last, r / reach);
      rows[static_cast<std::size_t>(r)] = lines_.data() + static_cast<std::ptrdiff_t>(above) * line_ * apart;
    }
    return rows;
  }

  Grid<Dim> grid_;
  const exec::Sharing* sharing_;
  int line_;            // points in a row, and those stored beyond its end
  int lines_in_layer_;  // the same for lines
  LocatedParticles<Dim, Real> particles_;
  std::vector<Real> slab_;   // sums, slab by slab, the fields side by side
  std::vector<Real> lines_;  // rows of the grid, the same
};

}  // namespace mesogen::mesh
