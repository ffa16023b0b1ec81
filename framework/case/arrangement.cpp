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

constexpr std::size_t plane = 2;

int nearest_count(double ratio) { return std::max(1, static_cast<int>(std::lround(ratio))); }

double wrapped(double x, double length) {
  x -= length * std::floor(x / length);
  return x < length ? x : 0.0;  // a tiny negative x is rounded to the length itself
}

bool is_hexagonal(const Case& source) { return source.particles.arrangement == "hexagonal"; }

constexpr std::array axis_names{"x", "y", "z"};

}  // namespace

std::string dimension_problem(const Case& source) {
  if (!is_hexagonal(source) || source.domain.size.size() == plane) return {};
  return fmt::format(
      "\"hexagonal\" is an arrangement of {} dimensions, and domain.size has {} numbers; take \"lattice\" "
      "or \"jittered\"",
      plane, source.domain.size.size());
}

LatticeCounts lattice_counts(const Case& source) {
  const auto& size = source.domain.size;
  const double spacing = source.particles.spacing;
  LatticeCounts counts;
  if (is_hexagonal(source)) {
    const Hexagonal hexagonal(spacing);
    const int rows = 2 * nearest_count(size[1] / (2.0 * hexagonal.row));
    counts.along = {nearest_count(size[0] * size[1] / (spacing * spacing * rows)), rows, 1};
  } else {
    for (std::size_t axis = 0; axis < size.size(); ++axis) counts.along[axis] = nearest_count(size[axis] / spacing);
  }
  return counts;
}

std::string arrangement_problem(const Case& source) {
  const auto& size = source.domain.size;
  const double spacing = source.particles.spacing;
  const LatticeCounts counts = lattice_counts(source);
  if (is_hexagonal(source)) {
    const Hexagonal hexagonal(spacing);
    const auto [columns, rows, layers] = counts.along;
    const double density = columns * spacing / size[0] * (rows * spacing / size[1]);
    const double stretch = size[1] / (rows * hexagonal.row);
    if (std::abs(density - 1.0) <= 0.02 && std::abs(stretch - 1.0) <= 0.1) return {};
    return fmt::format(
        "does not fit the box: {} columns and {} rows would change the density by {:+.1f} % and the distance of rows "
        "by {:+.1f} %; choose another spacing or box",
        columns, rows, 100.0 * (density - 1.0), 100.0 * (stretch - 1.0));
  }
  for (std::size_t axis = 0; axis < size.size(); ++axis) {
    const double fitting = size[axis] / counts.along[axis];
    if (std::abs(fitting / spacing - 1.0) <= 0.01) continue;
    return fmt::format("does not fit the box: {0} {1} are {2:.2f} spacings along {3}; {4:.6g} {1} would make it {5}",
                       size[axis], source.units.length, size[axis] / spacing, axis_names.at(axis), fitting,
                       counts.along[axis]);
  }
  return {};
}

std::string fitted_spacing_text(const Case& source) {
  const auto& size = source.domain.size;
  const LatticeCounts counts = lattice_counts(source);
  const std::string& unit = source.units.length;
  const double spacing = source.particles.spacing;
  const Hexagonal regular(spacing);
  const std::array<double, 3> wanted =
      is_hexagonal(source) ? std::array{regular.column, regular.row, spacing} : std::array{spacing, spacing, spacing};
  bool differs = false;
  std::string text;
  for (std::size_t axis = 0; axis < size.size(); ++axis) {
    const double fitted = size[axis] / counts.along[axis];
    differs = differs || std::abs(fitted / wanted[axis] - 1.0) > 1e-9;
    text += fmt::format("{}{:.6g} {} along {}", text.empty() ? "" : ", ", fitted, unit, axis_names.at(axis));
  }
  if (!differs) return {};
  if (is_hexagonal(source))
    return fmt::format("columns {:.6g} {} and rows {:.6g} {} apart, so that they fit the box",
                       size[0] / counts.along[0], unit, size[1] / counts.along[1], unit);
  return "spacing " + text + ", so that whole rows fit the box";
}

Arrangement arrange(const Case& source) {
  const auto& size = source.domain.size;
  const auto& particles = source.particles;
  const LatticeCounts counts = lattice_counts(source);
  const bool hexagonal = is_hexagonal(source);
  const double shift = particles.arrangement == "jittered" ? particles.jitter * particles.spacing : 0.0;
  Arrangement result;
  result.count = counts.along[0] * counts.along[1] * counts.along[2];
  for (std::size_t axis = 0; axis < size.size(); ++axis)
    result.position[axis].resize(static_cast<std::size_t>(result.count));
  for (Index id = 0; id < result.count; ++id) {
    const Index row = id / counts.along[0];
    const std::array<Index, 3> at = {id % counts.along[0], row % counts.along[1], row / counts.along[1]};
    for (std::size_t axis = 0; axis < size.size(); ++axis) {
      // in a hexagonal arrangement particles stand over the gaps of the row below
      const double start = hexagonal && axis == 0 ? (row % 2 == 0 ? 0.25 : 0.75) : 0.5;
      const double lattice = (at[axis] + start) * size[axis] / counts.along[axis];
      const double random = exec::random_uniform(particles.seed, std::int64_t{id}, static_cast<std::int64_t>(axis));
      result.position[axis][static_cast<std::size_t>(id)] = wrapped(lattice + shift * (2.0 * random - 1.0), size[axis]);
    }
  }
  return result;
}

}  // namespace mesogen
