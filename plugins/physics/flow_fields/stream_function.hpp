#pragma once

// The stream function of a plane flow, by Fourier modes that are fitted to the velocity of the particles.

#include <cstdint>
#include <vector>

#include "mesogen/mesh/particle_spectrum.hpp"
#include "mesogen/plugin/context.hpp"

namespace mesogen::flow_fields {

/// psi with u = d psi / dy, v = -d psi / dx and the mean 0, in a periodic box:
///
///     lap psi = -omega,   so for each wave vector   psi_k = i (k_x v_k - k_y u_k) / k^2.
///
/// The mean velocity, whose psi is not periodic, has no part in it, nor has what diverges: of a compressible flow it is
/// the part without divergence (Helmholtz).
class StreamFunction {
 public:
  explicit StreamFunction(const mesh::Grid<2>& grid)
      : spectrum_(grid), u_(spectrum_.mode_count()), v_(spectrum_.mode_count()) {}

  /// `mesh_spacing`: distance of the points of the mesh, in particle spacings, about.
  static mesh::Grid<2> grid_of(const Scene& scene, double mesh_spacing) {
    mesh::Grid<2> grid;
    for (std::size_t d = 0; d < 2; ++d) {
      grid.length[d] = scene.box[d];
      grid.points[d] = mesh::fast_size(scene.box[d] / (mesh_spacing * scene.spacing));
    }
    return grid;
  }

  /// Approximate memory, in bytes: of its own modes, and of the mesh.
  static double memory(const mesh::Grid<2>& grid, Index particles) {
    return static_cast<double>(2 * grid.mode_count() * sizeof(mesh::Complex)) +
           mesh::ParticleSpectrum<2>::bytes(grid, particles, 2, 1);
  }

  /// psi at the particles, m2/s, from their velocity, m/s. Throws Error(run_failed) where a point of the mesh has
  /// hardly any particle about it.
  template <class Real>
  void find(const PassContext& context, const FieldView<const Real>& velocity, const FieldView<Real>& psi) {
    if (located_ != context.positions_version()) {
      spectrum_.locate({context.position(0), context.position(1)}, context.count());
      located_ = context.positions_version();
    }
    spectrum_.fit<2>(
        [&](Index i, double* numbers) {
          numbers[0] = static_cast<double>(velocity(0, i));
          numbers[1] = static_cast<double>(velocity(1, i));
        },
        {u_.data(), v_.data()}, corrections);
    spectrum_.evaluate<1>(
        [&](std::size_t n, const auto& k, mesh::Complex* mode) {
          const double square = k[0] * k[0] + k[1] * k[1];
          *mode = square > 0.0 ? mesh::Complex(0.0, 1.0 / square) * (k[0] * v_[n] - k[1] * u_[n]) : mesh::Complex(0.0);
        },
        [&](Index i, const double* there) { psi(0, i) = Real(*there); });
  }

 private:
  static constexpr int corrections = 3;

  mesh::ParticleSpectrum<2> spectrum_;
  std::vector<mesh::Complex> u_;  // of the velocity
  std::vector<mesh::Complex> v_;
  std::uint64_t located_ = 0;
};

}  // namespace mesogen::flow_fields
