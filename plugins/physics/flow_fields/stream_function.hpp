#pragma once

// The stream function of a plane flow, by Fourier modes that are fitted to the velocity of the particles.

#include <array>
#include <cstdint>

#include "mesogen/exec/array.hpp"
#include "mesogen/mesh/pass_spectrum.hpp"
#include "mesogen/plugin/context.hpp"

namespace mesogen::flow_fields {

template <class Real>
struct VelocityInDouble {
  FieldView<const Real> velocity;

  MESOGEN_HOST_DEVICE void operator()(Index i, double* numbers) const {
    numbers[0] = static_cast<double>(velocity(0, i));
    numbers[1] = static_cast<double>(velocity(1, i));
  }
};

/// psi_k = i (k_x v_k - k_y u_k) / k^2.
struct ModesOfStreamFunction {
  const mesh::Complex* u;
  const mesh::Complex* v;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, 2>& k, mesh::Complex* mode) const {
    const double square = k[0] * k[0] + k[1] * k[1];
    *mode = square > 0.0 ? mesh::derivative(1.0 / square, k[0] * v[n] - k[1] * u[n]) : mesh::Complex(0.0);
  }
};

template <class Real>
struct PutInto {
  FieldView<Real> psi;

  MESOGEN_HOST_DEVICE void operator()(Index i, const double* there) const { psi(0, i) = Real(*there); }
};

/// psi with u = d psi / dy, v = -d psi / dx and the mean 0, in a periodic box:
///
///     lap psi = -omega,   so for each wave vector   psi_k = i (k_x v_k - k_y u_k) / k^2.
///
/// The mean velocity, whose psi is not periodic, has no part in it, nor has what diverges: of a compressible flow it is
/// the part without divergence (Helmholtz).
class StreamFunction {
 public:
  /// `context`: of the passes that will use it.
  StreamFunction(const mesh::Grid<2>& grid, const PassContext& context)
      : spectrum_(grid, context.device_mesh(), context.sharing()), u_(spectrum_.memory()), v_(spectrum_.memory()) {
    u_.resize(spectrum_.mode_count());
    v_.resize(spectrum_.mode_count());
  }

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
           mesh::PassSpectrum<2>::bytes(grid, particles, 2, 1);
  }

  /// psi at the particles, m2/s, from their velocity, m/s. Throws Error(run_failed) where a point of the mesh has
  /// hardly any particle about it.
  template <class Real>
  void find(const PassContext& context, const FieldView<const Real>& velocity, const FieldView<Real>& psi) {
    using exec::Access;
    if (located_ != context.positions_version()) {
      spectrum_.locate({context.position(0), context.position(1)}, context.count());
      located_ = context.positions_version();
    }
    spectrum_.fit<2>(VelocityInDouble<Real>{velocity}, {u_.device(Access::read_write), v_.device(Access::read_write)},
                     corrections);
    spectrum_.evaluate<1>(ModesOfStreamFunction{u_.device(), v_.device()}, PutInto<Real>{psi});
  }

 private:
  static constexpr int corrections = 3;

  mesh::PassSpectrum<2> spectrum_;
  exec::Array<mesh::Complex> u_;  // of the velocity
  exec::Array<mesh::Complex> v_;
  std::uint64_t located_ = 0;
};

}  // namespace mesogen::flow_fields
