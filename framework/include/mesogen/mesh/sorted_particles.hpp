#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "mesogen/exec/array.hpp"
#include "mesogen/mesh/cells_of_particles.hpp"
#include "mesogen/mesh/device_mesh.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

/// Where a particle is in the grid.
template <int Dim>
struct PlaceInGrid {
  const double* position[Dim];
  int points[Dim];
  double origin[Dim];
  double per_length[Dim];

  /// Distance from the first point, in cells.
  [[nodiscard]] MESOGEN_HOST_DEVICE double in_cells(int d, Index i) const {
    return (position[d][i] - origin[d]) * per_length[d];
  }
  /// False also of what is not a number.
  [[nodiscard]] MESOGEN_HOST_DEVICE bool is_known(int d, Index i) const {
    const double x = position[d][i] * per_length[d];
    return (x < 0.0 ? -x : x) < 1e9 * points[d];
  }
  [[nodiscard]] MESOGEN_HOST_DEVICE int first_point(int d, Index i) const {
    if (!is_known(d, i)) return 0;
    std::int64_t first = static_cast<std::int64_t>(floor(in_cells(d, i))) - 1;
    if (first < 0) first += points[d];  // division takes long, and hardly a particle is more than one box away
    if (first < 0 || first >= points[d]) first = (first % points[d] + points[d]) % points[d];
    return static_cast<int>(first);
  }
};

template <int Dim>
struct FindCell {
  PlaceInGrid<Dim> place;
  Index* key;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Index cell = 0;
    for (int d = Dim - 1; d >= 0; --d) cell = cell * place.points[d] + place.first_point(d, i);
    key[i] = cell;
  }
};

struct FindBegin {
  const Index* cell;
  Index* begin;
  Index count, cells;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index last = n == count ? cells : cell[n];
    for (Index c = n == 0 ? 0 : cell[n - 1] + 1; c <= last; ++c) begin[c] = n;
  }
};

template <int Dim, class Real>
struct FindFraction {
  PlaceInGrid<Dim> place;
  const Index* particle;
  Real* fraction;
  Index count;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index i = particle[n];
    for (int d = 0; d < Dim; ++d) {
      const double x = place.in_cells(d, i);
      fraction[d * static_cast<std::ptrdiff_t>(count) + n] =
          place.is_known(d, i) ? static_cast<Real>(x - floor(x)) : std::numeric_limits<Real>::quiet_NaN();
    }
  }
};

}  // namespace loops

/// Sorts particles by the cells of a grid, on a device.
template <int Dim, class Real>
class SortedParticles {
 public:
  SortedParticles(const Grid<Dim>& grid, const DeviceMesh& device)
      : grid_(grid),
        device_(device),
        key_(&device.memory()),
        cell_(&device.memory()),
        particle_(&device.memory()),
        begin_(&device.memory()),
        fraction_(&device.memory()) {
    begin_.resize_for_overwrite(grid.point_count() + 1);
  }

  [[nodiscard]] Index count() const { return static_cast<Index>(particle_.size()); }

  /// As LocatedParticles::locate. `position`: on the device. Where the position of a particle is no number, neither are
  /// its weights.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin) {
    const auto size = static_cast<std::size_t>(count);
    for (auto* const array : {&key_, &cell_, &particle_}) array->resize_for_overwrite(size);
    fraction_.resize_for_overwrite(Dim * size);
    using exec::Access;
    loops::PlaceInGrid<Dim> place{};
    for (int d = 0; d < Dim; ++d) {
      place.position[d] = position[d];
      place.points[d] = grid_.points[d];
      place.origin[d] = origin[d];
      place.per_length[d] = 1.0 / grid_.spacing(d);
    }
    const exec::Space space = device_.space();
    const auto cells = static_cast<Index>(grid_.point_count());
    exec::for_each(space, count, loops::FindCell<Dim>{place, key_.device(Access::write)}, "finding cells of the mesh");
    device_.sort(key_.device(), count, cells, cell_.device(Access::write), particle_.device(Access::write));
    exec::for_each(space, count + 1, loops::FindBegin{cell_.device(), begin_.device(Access::write), count, cells},
                   "cells of the mesh");
    exec::for_each(space, count,
                   loops::FindFraction<Dim, Real>{place, particle_.device(), fraction_.device(Access::write), count},
                   "places in the mesh");
  }

  [[nodiscard]] CellsOfParticles<Dim, Real> cells() const {
    CellsOfParticles<Dim, Real> all{};
    for (int d = 0; d < Dim; ++d) all.points[d] = grid_.points[d];
    all.count = count();
    all.particle = particle_.device();
    all.cell = cell_.device();
    all.begin = begin_.device();
    all.fraction = fraction_.device();
    return all;
  }

  /// Bytes per particle.
  static constexpr double bytes = 3.0 * sizeof(Index) + Dim * sizeof(Real);

 private:
  Grid<Dim> grid_;
  const DeviceMesh& device_;
  exec::Array<Index> key_;
  exec::Array<Index> cell_;
  exec::Array<Index> particle_;
  exec::Array<Index> begin_;
  exec::Array<Real> fraction_;
};

}  // namespace mesogen::mesh
