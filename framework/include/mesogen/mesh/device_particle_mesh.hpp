#pragma once

#include <array>

#include "mesogen/exec/array.hpp"
#include "mesogen/mesh/sorted_particles.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

template <int Dim, class Real>
struct FindWeight {
  CellsOfParticles<Dim, Real> cells;
  Real* weight;

  MESOGEN_HOST_DEVICE void operator()(Index point) const {
    Real sum = Real(0);
    cells.around(point, [&](Index, Real of_particle) { sum += of_particle; });
    weight[point] = sum;
  }
};

template <int Dim, class Real, int Count>
struct AddUp {
  CellsOfParticles<Dim, Real> cells;
  const Real* number;
  const Real* weight;
  Real* to;
  Index points;

  MESOGEN_HOST_DEVICE void operator()(Index point) const {
    Real sum[Count] = {};
    cells.around(point, [&](Index n, Real of_particle) {
      exec::unroll<Count>(
          [&](auto c) { sum[c] += of_particle * number[static_cast<std::ptrdiff_t>(c) * cells.count + n]; });
    });
    exec::unroll<Count>([&](auto c) { to[static_cast<std::ptrdiff_t>(c) * points + point] = sum[c] / weight[point]; });
  }
};

/// In the order of cells, so that a point finds the numbers of particles side by side.
template <int Dim, class Real, int Count, bool Missing, class Value>
struct NoteNumbers {
  CellsOfParticles<Dim, Real> cells;
  Value value;
  const Real* fields;
  Real* to;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    Real numbers[Count];
    value(cells.particle[n], numbers);
    if constexpr (Missing) {
      Real there[Count];
      cells.template interpolate<Count>(n, fields, there);
      exec::unroll<Count>([&](auto c) { numbers[c] -= there[c]; });
    }
    exec::unroll<Count>([&](auto c) { to[static_cast<std::ptrdiff_t>(c) * cells.count + n] = numbers[c]; });
  }
};

template <int Dim, class Real, int Count, class Take>
struct Gather {
  CellsOfParticles<Dim, Real> cells;
  Take take;
  const Real* fields;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    Real numbers[Count];
    cells.template interpolate<Count>(n, fields, numbers);
    take(cells.particle[n], numbers);
  }
};

}  // namespace loops

/// A ParticleMesh on a device. Every point adds up the particles that use it, in one order: nobody adds to a place of
/// somebody else, so results have the same bits in every run. Fields are stored field after field without gaps. All
/// functors must be trivially copyable and run on a device.
template <int Dim, class Real>
class DeviceParticleMesh {
 public:
  DeviceParticleMesh(const Grid<Dim>& grid, const DeviceMesh& device)
      : points_(static_cast<Index>(grid.point_count())),
        space_(device.space()),
        particles_(grid, device),
        numbers_(&device.memory()) {}

  /// Approximate memory in bytes for so many particles, of which `spread` numbers each are spread at a time.
  static double bytes(Index particles, int spread) {
    return particles * (SortedParticles<Dim, Real>::bytes + static_cast<double>(sizeof(Real)) * spread);
  }

  [[nodiscard]] Index count() const { return particles_.count(); }

  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin) {
    particles_.locate(position, count, origin);
  }

  /// weight(x) = sum over particles of their weight at x.
  void find_weights(Real* weight) const {
    exec::for_each(space_, points_, loops::FindWeight<Dim, Real>{particles_.cells(), weight}, "weights of the mesh");
  }

  /// Sets `Count` fields: to(c, x) = sum over particles of weight(x - x_i) value_c(i), over weight(x).
  template <int Count, class Value>
  void spread(const Value& value, const Real* weight, Real* to) {
    note_numbers<Count, false>(value, nullptr);
    add_up<Count>(weight, to);
  }
  /// The same of what the fields miss at the particles, in place of the fields.
  template <int Count, class Value>
  void spread_missing(const Value& value, const Real* weight, Real* fields) {
    note_numbers<Count, true>(value, fields);
    add_up<Count>(weight, fields);
  }

  /// Calls take(i, numbers) for every particle, with the values that the first `Count` fields have there.
  template <int Count, class Take>
  void gather(const Real* fields, const Take& take) const {
    exec::for_each(space_, count(), loops::Gather<Dim, Real, Count, Take>{particles_.cells(), take, fields},
                   "interpolation from the mesh to particles");
  }

 private:
  template <int Count, bool Missing, class Value>
  void note_numbers(const Value& value, const Real* fields) {
    const auto size = static_cast<std::size_t>(Count) * static_cast<std::size_t>(count());
    if (numbers_.size() < size) numbers_.resize_for_overwrite(size);
    exec::for_each(space_, count(),
                   loops::NoteNumbers<Dim, Real, Count, Missing, Value>{particles_.cells(), value, fields,
                                                                        numbers_.device(exec::Access::write)},
                   "numbers for the mesh");
  }
  template <int Count>
  void add_up(const Real* weight, Real* to) const {
    exec::for_each(space_, points_,
                   loops::AddUp<Dim, Real, Count>{particles_.cells(), numbers_.device(), weight, to, points_},
                   "spreading from particles to the mesh");
  }

  Index points_;
  exec::Space space_;
  SortedParticles<Dim, Real> particles_;
  exec::Array<Real> numbers_;  // of particles, in the order of cells
};

}  // namespace mesogen::mesh
