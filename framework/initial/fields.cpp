#include "initial/fields.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "initial/defects.hpp"
#include "mesogen/exec/random.hpp"

namespace mesogen {

namespace {

/// Random numbers of the director; streams 0 to 2 shift particles.
constexpr std::int64_t director_stream = 3;

/// amplitude * cos(k . x + phase) and its argument's wave vector, of one row of modes.
struct Wave {
  double kx;
  double ky;
  double amplitude;
  double phase;

  Wave(const std::vector<double>& row, const std::vector<double>& box)
      : kx(2.0 * std::numbers::pi * row[0] / box[0]),
        ky(2.0 * std::numbers::pi * row[1] / box[1]),
        amplitude(row[2]),
        phase(row[3]) {}
  [[nodiscard]] double argument(double x, double y) const { return kx * x + ky * y + phase; }
};

std::vector<Wave> waves(const Case::Rows& rows, const std::vector<double>& box) {
  std::vector<Wave> result;
  for (const auto& row : rows) result.emplace_back(row, box);
  return result;
}

/// The director at a particle.
using DirectorFunction = std::function<DirectorValue(Index id, double x, double y)>;

DirectorFunction director_function(const Case& source) {
  const auto& director = source.director;
  const double order = director.order;
  if (director.type == "perturbed")
    return [&director, order](Index id, double, double) {
      const double random = exec::random_uniform(director.seed, id, director_stream);
      return DirectorValue{order, director.angle + director.amplitude * (2.0 * random - 1.0)};
    };
  if (director.type == "modes")
    return [&director, order, modes = waves(director.modes, source.domain.size)](Index, double x, double y) {
      double angle = director.angle;
      for (const auto& wave : modes) angle += wave.amplitude * std::cos(wave.argument(x, y));
      return DirectorValue{order, angle};
    };
  if (director.type == "defects")
    return [&director, order, defects = DefectField(source)](Index, double x, double y) {
      const auto value = defects.at(x, y);
      return DirectorValue{order * value.order, director.angle + value.angle};
    };
  return [&director, order](Index, double, double) { return DirectorValue{order, director.angle}; };
}

}  // namespace

std::array<std::vector<double>, 2> initial_order_tensor(const Case& source, const Arrangement& particles) {
  const auto count = static_cast<std::size_t>(particles.count);
  std::array<std::vector<double>, 2> tensor = {std::vector<double>(count), std::vector<double>(count)};
  const auto director = director_function(source);
#pragma omp parallel for schedule(static)
  for (Index id = 0; id < particles.count; ++id) {
    const auto i = static_cast<std::size_t>(id);
    const auto value = director(id, particles.position[0][i], particles.position[1][i]);
    tensor[0][i] = value.order * std::cos(2.0 * value.angle);
    tensor[1][i] = value.order * std::sin(2.0 * value.angle);
  }
  return tensor;
}

std::array<std::vector<double>, 2> initial_velocity(const Case& source, const Arrangement& particles) {
  const auto count = static_cast<std::size_t>(particles.count);
  const auto& velocity = source.velocity;
  std::array<std::vector<double>, 2> u = {std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  if (velocity.type == "uniform") {
    u[0].assign(count, velocity.value[0]);
    u[1].assign(count, velocity.value[1]);
  }
  // u = (d psi / dy, -d psi / dx) of the stream function psi: free of divergence
  for (const auto& wave : waves(velocity.modes, source.domain.size))
    for (std::size_t i = 0; i < count; ++i) {
      const double slope =
          -wave.amplitude * std::sin(wave.argument(particles.position[0][i], particles.position[1][i]));
      u[0][i] += slope * wave.ky;
      u[1][i] -= slope * wave.kx;
    }
  return u;
}

std::vector<double> initial_colour(const Case& source, const Arrangement& particles) {
  const auto count = static_cast<std::size_t>(particles.count);
  std::vector<double> colour(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool inside = particles.position[0][i] < 0.5 * source.domain.size[0] &&
                        particles.position[1][i] < 0.5 * source.domain.size[1];
    colour[i] = inside ? 1.0 : 0.0;
  }
  return colour;
}

}  // namespace mesogen
