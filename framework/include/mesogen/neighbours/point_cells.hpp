#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/counting_sort.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// Points of a box sorted into cells, for searches on the host. Observers use it. The pair passes of a run have their
/// own, faster grid (Neighbours).
///
/// The order in which points are visited depends only on their numbers and coordinates. Along periodic axes every image
/// within the radius is visited, so a radius larger than half the box is allowed.
template <int Dim>
class PointCells {
 public:
  using Point = std::array<double, Dim>;

  /// `points`: coordinates, m, also outside the box. `width`: smallest width of a cell, m. The radius of later
  /// searches, or a part of it, is a good choice. Of `scene`, the box and the periodic axes are used.
  PointCells(const Scene& scene, const std::vector<Point>& points, double width) {
    const auto& box = scene.box;
    double volume = 1.0;
    for (int d = 0; d < Dim; ++d) volume *= box[index(d)];
    // Cells that are much smaller than the distance of points would cost memory and time without gain.
    const double finest = 0.5 * std::pow(volume / static_cast<double>(points.size() + 1), 1.0 / Dim);
    int total = 1;
    for (int d = 0; d < Dim; ++d) {
      length_[index(d)] = box[index(d)];
      periodic_[index(d)] = scene.periodic[index(d)];
      cells_[index(d)] = std::max(1, static_cast<int>(length_[index(d)] / std::max(width, finest)));
      width_[index(d)] = length_[index(d)] / cells_[index(d)];
      total *= cells_[index(d)];
    }
    sort(points, static_cast<std::size_t>(total));
  }

  /// Returns the point moved into the box, [0, box), along periodic axes.
  [[nodiscard]] Point wrapped(Point point) const {
    for (int d = 0; d < Dim; ++d) {
      if (!periodic_[index(d)]) continue;
      double& x = point[index(d)];
      if (x >= 0.0 && x < length_[index(d)]) continue;
      x -= std::floor(x / length_[index(d)]) * length_[index(d)];
      if (x < 0.0 || x >= length_[index(d)]) x = 0.0;
    }
    return point;
  }

  /// Calls visit(number of the point, displacement from the centre to it, square of its length) for every point at a
  /// distance of at most `radius`, and for every periodic image of a point within that distance.
  template <class Visit>
  void within(const Point& somewhere, double radius, const Visit& visit) const {
    const Point centre = wrapped(somewhere);
    std::array<int, Dim> first{};
    std::array<int, Dim> last{};
    for (int d = 0; d < Dim; ++d) {
      first[index(d)] = static_cast<int>(std::floor((centre[index(d)] - radius) / width_[index(d)]));
      last[index(d)] = static_cast<int>(std::floor((centre[index(d)] + radius) / width_[index(d)]));
      if (periodic_[index(d)]) continue;
      first[index(d)] = std::clamp(first[index(d)], 0, cells_[index(d)] - 1);
      last[index(d)] = std::clamp(last[index(d)], 0, cells_[index(d)] - 1);
    }
    std::array<int, Dim> at = first;
    while (at[index(Dim - 1)] <= last[index(Dim - 1)]) {
      visit_cell(at, centre, radius * radius, visit);
      int d = 0;
      while (++at[index(d)] > last[index(d)] && d < Dim - 1) {
        at[index(d)] = first[index(d)];
        ++d;
      }
    }
  }

  /// Returns the square of the smallest distance between two points, also across periodic faces, m2, if that distance
  /// is at most the `width` of the constructor. Otherwise returns a larger square, or infinity.
  [[nodiscard]] double closest_square() const {
    double closest = std::numeric_limits<double>::infinity();
    const auto rows = static_cast<int>((begin_.size() - 1) / static_cast<std::size_t>(cells_[0]));
#pragma omp parallel for schedule(static) reduction(min : closest) if (count() >= exec::parallel_from)
    for (int row = 0; row < rows; ++row) closest = std::min(closest, closest_of_row(row));
    return closest;
  }

 private:
  static constexpr std::size_t index(int d) { return static_cast<std::size_t>(d); }

  [[nodiscard]] int cell_of(const Point& inside) const {
    int cell = 0;
    for (int d = Dim - 1; d >= 0; --d) {
      const int at = static_cast<int>(inside[index(d)] / width_[index(d)]);
      cell = cell * cells_[index(d)] + std::clamp(at, 0, cells_[index(d)] - 1);
    }
    return cell;
  }

  [[nodiscard]] Index count() const { return static_cast<Index>(number_.size()); }

  // By rows, which are all cells along the first axis, then by cells within each row; in the order of points within a
  // cell.
  void sort(const std::vector<Point>& points, std::size_t cells) {
    const auto count = static_cast<Index>(points.size());
    const auto columns = static_cast<std::size_t>(cells_[0]);
    std::vector<int> cell(points.size());
#pragma omp parallel for schedule(static) if (count >= exec::parallel_from)
    for (Index i = 0; i < count; ++i)
      cell[static_cast<std::size_t>(i)] = cell_of(wrapped(points[static_cast<std::size_t>(i)]));
    std::vector<Index> by_row(points.size());
    const auto begin_of_row = exec::counting_sort(
        count, cells / columns, [&](Index i) { return cell[static_cast<std::size_t>(i)] / cells_[0]; },
        [&](Index i, Index to) { by_row[static_cast<std::size_t>(to)] = i; });
    begin_.resize(cells + 1);
    begin_[cells] = count;
    number_.resize(points.size());
    point_.resize(points.size());
    const auto rows = static_cast<std::ptrdiff_t>(cells / columns);
#pragma omp parallel if (count >= exec::parallel_from)
    {
      std::vector<Index> next(columns);
#pragma omp for schedule(static)
      for (std::ptrdiff_t row = 0; row < rows; ++row) {
        const std::size_t first = static_cast<std::size_t>(row) * columns;
        const auto begin = static_cast<std::size_t>(begin_of_row[static_cast<std::size_t>(row)]);
        const auto end = static_cast<std::size_t>(begin_of_row[static_cast<std::size_t>(row) + 1]);
        const auto column = [&](std::size_t n) {
          return static_cast<std::size_t>(cell[static_cast<std::size_t>(by_row[n])]) - first;
        };
        std::fill(next.begin(), next.end(), 0);
        for (std::size_t n = begin; n < end; ++n) ++next[column(n)];
        auto total = static_cast<Index>(begin);
        for (std::size_t c = 0; c < columns; ++c) {
          begin_[first + c] = total;
          total += std::exchange(next[c], total);
        }
        for (std::size_t n = begin; n < end; ++n) {
          const auto slot = static_cast<std::size_t>(next[column(n)]++);
          number_[slot] = by_row[n];
          point_[slot] = wrapped(points[static_cast<std::size_t>(by_row[n])]);
        }
      }
    }
  }

  // Of each two neighbouring cells one compares its points with those of the other: the one in front, along the row or
  // in the rows before.
  [[nodiscard]] double closest_of_row(int row) const {
    double closest = std::numeric_limits<double>::infinity();
    std::array<int, Dim> at{};
    for (int d = 1, rest = row; d < Dim; rest /= cells_[index(d)], ++d) at[index(d)] = rest % cells_[index(d)];
    constexpr int rows_around = Dim == 2 ? 3 : 9;  // the middle one is this row
    for (int column = 0; column < cells_[0]; ++column) {
      const auto cell =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_[0]) + static_cast<std::size_t>(column);
      for (int around = rows_around / 2; around < rows_around; ++around) {
        std::array<int, Dim> there = at;
        for (int d = 1, rest = around; d < Dim; rest /= 3, ++d) there[index(d)] += rest % 3 - 1;
        const bool same = around == rows_around / 2;
        for_runs(there, same ? column : column - 1, column + 1, [&](Index begin, Index end, const Point& shift) {
          const bool behind = same && shift[0] == 0.0;
          for (Index k = begin_[cell]; k < begin_[cell + 1]; ++k)
            closest = std::min(closest, closest_to(k, behind ? k + 1 : begin, end, shift));
        });
      }
    }
    return closest;
  }

  // Of the points from `begin` to `end`, moved by `shift`, but for the k-th itself.
  [[nodiscard]] double closest_to(Index k, Index begin, Index end, const Point& shift) const {
    double closest = std::numeric_limits<double>::infinity();
    Point from = point_[static_cast<std::size_t>(k)];
    for (int d = 0; d < Dim; ++d) from[index(d)] -= shift[index(d)];
    for (Index n = begin; n < end; ++n) {
      double square = n == k ? closest : 0.0;
      for (int d = 0; d < Dim; ++d) {
        const double along = point_[static_cast<std::size_t>(n)][index(d)] - from[index(d)];
        square += along * along;
      }
      closest = std::min(closest, square);
    }
    return closest;
  }

  // Calls visit(begin, end, shift) for the cells from column `first` to `last` of a row, whose points lie one behind
  // the other. Columns and rows may lie one beyond the ends of the box: `shift` brings the points there.
  template <class Visit>
  void for_runs(const std::array<int, Dim>& row, int first, int last, const Visit& visit) const {
    Point shift{};
    std::ptrdiff_t number = 0;
    for (int d = Dim - 1; d > 0; --d) {
      const int cells = cells_[index(d)];
      const int image = row[index(d)] < 0 ? -1 : row[index(d)] / cells;
      if (image != 0 && !periodic_[index(d)]) return;
      shift[index(d)] = image * length_[index(d)];
      number = number * cells + row[index(d)] - image * cells;
    }
    const int columns = cells_[0];
    if (first >= 0 && last < columns)
      return visit(begin_[index_of(number, first)], begin_[index_of(number, last) + 1], shift);
    for (const int image : {-1, 0, 1}) {
      const int from = std::max(first - image * columns, 0);
      const int to = std::min(last - image * columns, columns - 1);
      if (from > to || (image != 0 && !periodic_[0])) continue;
      shift[0] = image * length_[0];
      visit(begin_[index_of(number, from)], begin_[index_of(number, to) + 1], shift);
    }
  }

  [[nodiscard]] std::size_t index_of(std::ptrdiff_t row, int column) const {
    return static_cast<std::size_t>(row * cells_[0] + column);
  }

  template <class Visit>
  void visit_cell(const std::array<int, Dim>& at, const Point& centre, double radius_squared,
                  const Visit& visit) const {
    int cell = 0;
    Point origin{};  // centre as seen from the stored image of this cell
    for (int d = Dim - 1; d >= 0; --d) {
      const int n = cells_[index(d)];
      int image = 0;
      if (at[index(d)] >= n) image = at[index(d)] / n;
      if (at[index(d)] < 0) image = -((n - 1 - at[index(d)]) / n);
      cell = cell * n + at[index(d)] - image * n;
      origin[index(d)] = centre[index(d)] - image * length_[index(d)];
    }
    const auto end = static_cast<std::size_t>(begin_[static_cast<std::size_t>(cell) + 1]);
    for (auto k = static_cast<std::size_t>(begin_[static_cast<std::size_t>(cell)]); k < end; ++k) {
      Point displacement{};
      double square = 0.0;
      for (int d = 0; d < Dim; ++d) {
        displacement[index(d)] = point_[k][index(d)] - origin[index(d)];
        square += displacement[index(d)] * displacement[index(d)];
      }
      if (square <= radius_squared) visit(number_[k], displacement, square);
    }
  }

  std::array<double, Dim> length_{};
  std::array<bool, Dim> periodic_{};
  std::array<double, Dim> width_{};
  std::array<int, Dim> cells_{};
  std::vector<Index> begin_;   // of each cell in the two below; one more than there are cells
  std::vector<Index> number_;  // of each point, cell by cell
  std::vector<Point> point_;
};

}  // namespace mesogen
