#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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
    begin_.assign(static_cast<std::size_t>(total) + 1, 0);
    std::vector<int> cell(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      cell[i] = cell_of(wrapped(points[i]));
      ++begin_[static_cast<std::size_t>(cell[i]) + 1];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    number_.resize(points.size());
    point_.resize(points.size());
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto slot = static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++);
      number_[slot] = static_cast<Index>(i);
      point_[slot] = wrapped(points[i]);
    }
  }

  /// Returns the point moved into the box, [0, box), along periodic axes.
  [[nodiscard]] Point wrapped(Point point) const {
    for (int d = 0; d < Dim; ++d) {
      if (!periodic_[index(d)]) continue;
      double& x = point[index(d)];
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
