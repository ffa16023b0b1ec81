#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/exact_sum.hpp"
#include "mesogen/mesh/particle_spectrum.hpp"
#include "mesogen/plugin/observer.hpp"

namespace mesogen::mesh {

/// Throws Error(bad_case) with the message `what` if the box has walls: modes exist only for periodic fields.
inline void needs_periodic_box(const Scene& scene, const char* what) {
  if (!scene.endless()) throw Error(ExitCode::bad_case, what);
}

/// Fourier modes of the fields that an observer sees, in a periodic box. They are fitted to the values of the
/// particles, and what spreading to the mesh takes away is restored (mesh/particle_spectrum.hpp). They reach two thirds
/// of the largest wave number that the mesh can represent.
template <int Dim>
class ObservedModes {
 public:
  using Complex = mesh::Complex;
  using Modes = std::vector<Complex>;

  /// `mesh_spacing`: approximate distance of the mesh points, in particle spacings.
  ObservedModes(const Scene& scene, double mesh_spacing) : spectrum_(grid_of(scene, mesh_spacing)) {}

  /// Takes the positions of the particles. `modes` then uses these positions.
  void locate(const ObserverContext& context) {
    std::array<std::vector<double>, Dim> position;
    std::array<const double*, Dim> at{};
    for (std::size_t d = 0; d < Dim; ++d) {
      position[d] = context.position(static_cast<int>(d));
      at[d] = position[d].data();
    }
    spectrum_.locate(at, static_cast<Index>(context.id().size()));
  }

  /// Returns the modes of the first `Count` components of a field. Throws Error(run_failed) if hardly any particle is
  /// near a point of the mesh.
  template <int Count>
  std::array<Modes, Count> modes(const ObserverContext& context, std::string_view field) {
    std::array<std::vector<double>, Count> values;
    std::array<Modes, Count> modes;
    std::array<Complex*, Count> to{};
    for (std::size_t c = 0; c < Count; ++c) {
      values[c] = context.values(field, static_cast<int>(c));
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

  /// Returns the share of a field's variance over the particles that modes do not hold. `mean_square` is what the modes
  /// hold of it. Returns NaN if the field is uniform up to rounding. On disordered particles, means over particles and
  /// over the box differ: a share below some 0.01 may then mean none, and the result may be below 0.
  template <int Count>
  static double share_beyond(const ObserverContext& context, std::string_view field, double mean_square) {
    constexpr double rounding = 1e-26;
    double whole = 0.0;
    double of_mean = 0.0;
    for (int c = 0; c < Count; ++c) {
      const auto values = context.values(field, c);
      const auto mean_of = [&](const auto& term) {
        const auto [sum] = exec::exact_sums<1>(static_cast<Index>(values.size()), [&](Index i, double(&at)[1]) {
          at[0] = term(values[static_cast<std::size_t>(i)]);
        });
        return sum / static_cast<double>(values.size());
      };
      const double mean = mean_of([](double value) { return value; });
      whole += mean_of([mean](double value) { return (value - mean) * (value - mean); });
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
