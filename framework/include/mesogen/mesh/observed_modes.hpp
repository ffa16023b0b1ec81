#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/mesh/particle_spectrum.hpp"
#include "mesogen/plugin/by_id.hpp"

namespace mesogen::mesh {

/// Throws Error(bad_case) with `what` where the box has walls: modes are those of periodic fields.
inline void needs_periodic_box(const Scene& scene, const char* what) {
  for (int d = 0; d < scene.dimension; ++d)
    if (!scene.periodic[static_cast<std::size_t>(d)]) throw Error(ExitCode::bad_case, what);
}

/// Fourier modes of the fields that an observer sees, in a periodic box: fitted to the values of the particles, with
/// what the spreading to a mesh takes away given back (mesh/particle_spectrum.hpp). They go as far as two thirds of
/// what the mesh can tell apart.
template <int Dim>
class ObservedModes {
 public:
  using Complex = mesh::Complex;
  using Modes = std::vector<Complex>;

  /// `mesh_spacing`: distance of the points of the mesh, in particle spacings, about.
  ObservedModes(const Scene& scene, double mesh_spacing) : spectrum_(grid_of(scene, mesh_spacing)) {}

  /// Where the particles are; what follows is about them.
  void locate(const ById& particles) {
    const auto points = particles.positions<Dim>();
    std::array<std::vector<double>, Dim> position;
    std::array<const double*, Dim> at{};
    for (std::size_t d = 0; d < Dim; ++d) {
      position[d].reserve(points.size());
      for (const auto& point : points) position[d].push_back(point[d]);
      at[d] = position[d].data();
    }
    spectrum_.locate(at, static_cast<Index>(points.size()));
  }

  /// Modes of the first `Count` components of a field. Throws Error(run_failed) where a point of the mesh has hardly
  /// any particle about it.
  template <int Count>
  std::array<Modes, Count> modes(const ById& particles, std::string_view field) {
    std::array<std::vector<double>, Count> values;
    std::array<Modes, Count> modes;
    std::array<Complex*, Count> to{};
    for (std::size_t c = 0; c < Count; ++c) {
      values[c] = particles.values(field, static_cast<int>(c));
      modes[c].resize(spectrum_.mode_count());
      to[c] = modes[c].data();
    }
    spectrum_.template fit<Count>(
        [&](Index i, double* numbers) {
          for (std::size_t c = 0; c < Count; ++c) numbers[c] = values[c][static_cast<std::size_t>(i)];
        },
        to, corrections);
    return modes;
  }

  /// The share of a field's mean square about its mean, over the particles, that lies beyond modes which hold
  /// `mean_square` of it. NaN where the field is the same everywhere, to rounding. On disordered particles means over
  /// particles and over the box differ, so a share below 0.01 or so may be none, and come out below 0.
  template <int Count>
  static double share_beyond(const ById& particles, std::string_view field, double mean_square) {
    constexpr double rounding = 1e-26;
    double whole = 0.0;
    double of_mean = 0.0;
    for (int c = 0; c < Count; ++c) {
      const auto values = particles.values(field, c);
      const auto count = static_cast<double>(values.size());
      double mean = 0.0;
      for (const double value : values) mean += value / count;
      for (const double value : values) whole += (value - mean) * (value - mean) / count;
      of_mean += mean * mean;
    }
    return whole > rounding * of_mean ? 1.0 - mean_square / whole : std::nan("");
  }

  [[nodiscard]] mesh::ParticleSpectrum<Dim>& spectrum() { return spectrum_; }
  [[nodiscard]] const mesh::Grid<Dim>& grid() const { return spectrum_.grid(); }

 private:
  static constexpr int corrections = 3;

  static mesh::Grid<Dim> grid_of(const Scene& scene, double mesh_spacing) {
    mesh::Grid<Dim> grid;
    for (std::size_t d = 0; d < Dim; ++d) {
      grid.length[d] = scene.box[d];
      grid.points[d] = mesh::fast_size(scene.box[d] / (mesh_spacing * scene.spacing));
    }
    return grid;
  }

  mesh::ParticleSpectrum<Dim> spectrum_;
};

}  // namespace mesogen::mesh
