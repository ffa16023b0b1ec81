#include "contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "mesogen/exec/compensated_sum.hpp"

namespace mesogen {

namespace {

constexpr double level = 0.5;

/// Corners of a square in the order of a walk around it.
constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// Length of the line in a square of the given edges, by the values at its corners.
double length_in_square(const std::array<double, 4>& value, const std::array<double, 2>& edge) {
  std::array<std::array<double, 2>, 4> crossing{};  // where the line enters or leaves, m from the first corner
  std::size_t crossings = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    if ((value[k] >= level) == (value[next] >= level)) continue;
    const double part = (level - value[k]) / (value[next] - value[k]);
    for (std::size_t d = 0; d < 2; ++d)
      crossing[crossings][d] = edge[d] * (corners[k][d] + part * (corners[next][d] - corners[k][d]));
    ++crossings;
  }
  const auto piece = [&](std::size_t a, std::size_t b) {
    return std::hypot(crossing[a][0] - crossing[b][0], crossing[a][1] - crossing[b][1]);
  };
  if (crossings == 0) return 0.0;
  if (crossings == 2) return piece(0, 1);
  // Two corners of a diagonal are cut off: those unlike the middle.
  const bool middle = value[0] + value[1] + value[2] + value[3] >= 4.0 * level;
  return middle == (value[0] >= level) ? piece(0, 1) + piece(2, 3) : piece(3, 0) + piece(1, 2);
}

constexpr int reach = mesh::CubicSpline::points;

int squares_along(const Scene& scene, std::size_t d, double mesh_spacing) {
  return std::max(reach, static_cast<int>(std::lround(scene.box[d] / (mesh_spacing * scene.spacing))));
}

// The mesh is periodic. Between walls it goes on beyond the box, as far as particles at one wall reach, and so they do
// not touch the nodes at the other.
mesh::Grid<2> grid_of(const Scene& scene, double mesh_spacing) {
  mesh::Grid<2> grid;
  for (std::size_t d = 0; d < 2; ++d) {
    const int squares = squares_along(scene, d, mesh_spacing);
    grid.points[d] = squares + (scene.periodic[d] ? 0 : reach);
    grid.length[d] = grid.points[d] * (scene.box[d] / squares);
  }
  return grid;
}

}  // namespace

ColourLine::ColourLine(const Scene& scene, double mesh_spacing)
    : mesh_(grid_of(scene, mesh_spacing)), means_(mesh_.grid(), 2) {
  for (std::size_t d = 0; d < 2; ++d) {
    squares_[d] = squares_along(scene, d, mesh_spacing);
    width_[d] = scene.box[d] / squares_[d];
  }
}

double ColourLine::length(const std::vector<std::vector<double>>& position, const std::vector<double>& colour) {
  average(position, colour);
  std::vector<double> of_row(static_cast<std::size_t>(squares_[1]));
#pragma omp parallel for schedule(static)
  for (int row = 0; row < squares_[1]; ++row) of_row[static_cast<std::size_t>(row)] = length_in_row(row);
  exec::CompensatedSum sum;
  for (const double length : of_row) sum.add(length);
  return sum.value();
}

void ColourLine::average(const std::vector<std::vector<double>>& position, const std::vector<double>& colour) {
  mesh_.locate({position[0].data(), position[1].data()}, static_cast<Index>(colour.size()));
  mesh_.spread<2>(
      [&](Index i, double* numbers) {
        numbers[0] = 1.0;
        numbers[1] = colour[static_cast<std::size_t>(i)];
      },
      means_,
      [&](int row) {
        const double* const weight = means_.row(0, row);
        double* const value = means_.row(1, row);
        for (int i = 0; i < mesh_.grid().points[0]; ++i)
          value[i] = weight[i] > 0.0 ? value[i] / weight[i] : std::numeric_limits<double>::quiet_NaN();
      });
}

double ColourLine::length_in_row(int row) const {
  const mesh::Grid<2>& grid = mesh_.grid();
  const auto columns = static_cast<std::size_t>(grid.points[0]);
  const double* const lower = means_.row(1, row);
  const double* const upper = means_.row(1, (row + 1) % grid.points[1]);
  exec::CompensatedSum sum;
  for (std::size_t i = 0; i < static_cast<std::size_t>(squares_[0]); ++i) {
    const std::size_t next = i + 1 < columns ? i + 1 : 0;
    const std::array<double, 4> value{lower[i], lower[next], upper[next], upper[i]};
    const auto above = std::count_if(value.begin(), value.end(), [](double x) { return x >= level; });
    if (above == 0 || above == 4) continue;
    if (std::none_of(value.begin(), value.end(), [](double x) { return std::isnan(x); }))
      sum.add(length_in_square(value, width_));
  }
  return sum.value();
}

}  // namespace mesogen
