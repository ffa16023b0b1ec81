#include "case/arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesogen/exec/random.hpp"

namespace mesogen {

namespace {

/// Distance of particles in a row and of rows of a hexagonal arrangement whose particles have the area spacing^2 each.
struct Hexagonal {
  double column;
  double row;
  explicit Hexagonal(double spacing)
      : column(spacing * std::sqrt(2.0 / std::sqrt(3.0))), row(spacing * std::sqrt(std::sqrt(3.0) / 2.0)) {}
};

int nearest_count(double ratio) { return std::max(1, static_cast<int>(std::lround(ratio))); }

double wrapped(double x, double length) {
  x -= length * std::floor(x / length);
  return x < length ? x : 0.0;  // a tiny negative x is rounded to the length itself
}

}  // namespace

LatticeCounts lattice_counts(const Case& source) {
  const auto& size = source.domain.size;
  const double spacing = source.particles.spacing;
  if (source.particles.arrangement != "hexagonal")
    return {nearest_count(size[0] / spacing), nearest_count(size[1] / spacing)};
  const Hexagonal hexagonal(spacing);
  const int rows = 2 * nearest_count(size[1] / (2.0 * hexagonal.row));
  return {nearest_count(size[0] * size[1] / (spacing * spacing * rows)), rows};
}

std::string arrangement_problem(const Case& source) {
  const auto& size = source.domain.size;
  const double spacing = source.particles.spacing;
  const auto counts = lattice_counts(source);
  if (source.particles.arrangement == "hexagonal") {
    const Hexagonal hexagonal(spacing);
    const double density = counts.columns * spacing / size[0] * (counts.rows * spacing / size[1]);
    const double stretch = size[1] / (counts.rows * hexagonal.row);
    if (std::abs(density - 1.0) <= 0.02 && std::abs(stretch - 1.0) <= 0.1) return {};
    return fmt::format(
        "does not fit the box: {} columns and {} rows would change the density by {:+.1f} % and the distance of rows "
        "by {:+.1f} %; choose another spacing or box",
        counts.columns, counts.rows, 100.0 * (density - 1.0), 100.0 * (stretch - 1.0));
  }
  const std::array<int, 2> count = {counts.columns, counts.rows};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double fitting = size[axis] / count[axis];
    if (std::abs(fitting / spacing - 1.0) <= 0.01) continue;
    return fmt::format("does not fit the box: {0} {1} are {2:.2f} spacings along {3}; {4:.6g} {1} would make it {5}",
                       size[axis], source.units.length, size[axis] / spacing, axis == 0 ? "x" : "y", fitting,
                       count[axis]);
  }
  return {};
}

std::string fitted_spacing_text(const Case& source) {
  const auto& size = source.domain.size;
  const double spacing = source.particles.spacing;
  const auto [columns, rows] = lattice_counts(source);
  const bool hexagonal = source.particles.arrangement == "hexagonal";
  const double column = size[0] / columns;
  const double row = size[1] / rows;
  const std::string& unit = source.units.length;
  const Hexagonal regular(spacing);
  const auto differs = [](double fitted, double wanted) { return std::abs(fitted / wanted - 1.0) > 1e-9; };
  if (!differs(column, hexagonal ? regular.column : spacing) && !differs(row, hexagonal ? regular.row : spacing))
    return {};
  if (hexagonal)
    return fmt::format("columns {:.6g} {} and rows {:.6g} {} apart, so that they fit the box", column, unit, row, unit);
  return fmt::format("spacing {:.6g} {} along x, {:.6g} {} along y, so that whole rows fit the box", column, unit, row,
                     unit);
}

Arrangement arrange(const Case& source) {
  const auto& size = source.domain.size;
  const auto& particles = source.particles;
  const auto counts = lattice_counts(source);
  const bool hexagonal = particles.arrangement == "hexagonal";
  const double shift = particles.arrangement == "jittered" ? particles.jitter * particles.spacing : 0.0;
  Arrangement result;
  result.count = counts.columns * counts.rows;
  const auto total = static_cast<std::size_t>(result.count);
  result.position[0].resize(total);
  result.position[1].resize(total);
  for (int row = 0; row < counts.rows; ++row) {
    // in a hexagonal arrangement particles stand over the gaps of the row below
    const double start = hexagonal ? (row % 2 == 0 ? 0.25 : 0.75) : 0.5;
    for (int column = 0; column < counts.columns; ++column) {
      const auto id =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(counts.columns) + static_cast<std::size_t>(column);
      const std::array<double, 2> lattice = {(column + start) * size[0] / counts.columns,
                                             (row + 0.5) * size[1] / counts.rows};
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double random =
            exec::random_uniform(particles.seed, static_cast<std::int64_t>(id), static_cast<std::int64_t>(axis));
        result.position[axis][id] = wrapped(lattice[axis] + shift * (2.0 * random - 1.0), size[axis]);
      }
    }
  }
  return result;
}

}  // namespace mesogen
