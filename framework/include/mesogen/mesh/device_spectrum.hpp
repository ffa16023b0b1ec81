#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesogen/mesh/device_mode_transform.hpp"
#include "mesogen/mesh/device_particle_mesh.hpp"
#include "mesogen/mesh/fitting.hpp"
#include "mesogen/mesh/ordered_sum.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

template <class Real>
struct Unevenness {
  const Real* weight;
  Real* to;
  Real per_mean;

  MESOGEN_HOST_DEVICE void operator()(Index point) const { to[point] = weight[point] * per_mean - Real(1); }
};

/// Square of the difference from the mean weight; 1 where there is hardly any.
template <class Real>
struct WeightOfPoint {
  const Real* weight;
  double mean;

  MESOGEN_HOST_DEVICE void operator()(Index point, double* sums) const {
    const auto here = static_cast<double>(weight[point]);
    sums[0] += (here - mean) * (here - mean);
    if (!(here > empty_weight * mean)) sums[1] += 1.0;
  }
};

/// Takes modes from the mesh.
template <int Dim, int Count>
struct TakeRestored {
  const double* restore;
  std::array<Complex*, Count> modes;
  bool adds;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>&, const Complex* spread) const {
    exec::unroll<Count>([&](auto c) {
      const Complex found = restore[n] * spread[c];
      modes[c][n] = adds ? modes[c][n] + found : found;
    });
  }
};

/// Modes as they are stored.
template <int Dim, int Count>
struct Stored {
  std::array<Complex*, Count> modes;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>&, Complex* numbers) const {
    exec::unroll<Count>([&](auto c) { numbers[c] = modes[c][n]; });
  }
};

/// Modes from which interpolation makes the field.
template <int Dim, int Count, class Mode>
struct Restoring {
  Mode mode;
  const double* restore;

  MESOGEN_HOST_DEVICE void operator()(std::size_t n, const std::array<double, Dim>& k, Complex* numbers) const {
    mode(n, k, numbers);
    exec::unroll<Count>([&](auto c) { numbers[c] *= restore[n]; });
  }
};

}  // namespace loops

/// A ParticleSpectrum on a device: see there. Positions, values, modes and the mesh lie in the memory of the device.
/// All functors must be trivially copyable and run on a device.
template <int Dim, class Real>
class DeviceSpectrum {
 public:
  DeviceSpectrum(const Grid<Dim>& grid, const DeviceMesh& device)
      : kept_(grid),
        space_(device.space()),
        mesh_(grid, device),
        transform_(kept_, device),
        restore_(&device.memory()),
        weight_(&device.memory()),
        sum_(&device.memory()) {
    std::vector<double> factors(grid.mode_count(), 0.0);
    kept_.for_each([&](std::size_t n, const auto& k) { factors[n] = restoring_factor<Dim>(grid, k); });
    restore_.assign(factors);
    weight_.resize_for_overwrite(grid.point_count());
  }

  /// As ParticleSpectrum::bytes.
  static double bytes(const Grid<Dim>& grid, Index particles, int fitted, int evaluated) {
    const auto points = static_cast<double>(grid.point_count());
    return DeviceParticleMesh<Dim, Real>::bytes(particles, fitted) +
           static_cast<double>(sizeof(Real)) * points * (2 * std::max(fitted, evaluated) + 1) +
           static_cast<double>(grid.mode_count() * sizeof(double));
  }

  [[nodiscard]] DeviceModeTransform<Dim, Real>& transform() { return transform_; }

  /// As ParticleSpectrum::locate, but whether a position is finite is found with the weights.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    mesh_.locate(position, count, origin);
    weighed_ = false;
  }

  void unevenness(Complex* modes) {
    weigh();
    const auto points = static_cast<Index>(kept_.grid().point_count());
    exec::for_each(space_, points,
                   loops::Unevenness<Real>{weight_.device(), transform_.points(1, exec::Access::write),
                                           static_cast<Real>(static_cast<double>(points) / mesh_.count())},
                   "the unevenness of particles");
    transform_.template to_modes<1>(loops::TakeRestored<Dim, 1>{restore_.device(), {modes}, false});
  }

  template <int Count, class Value>
  void fit(const Value& value, const std::array<Complex*, Count>& modes, int corrections) {
    using exec::Access;
    weigh();
    const auto spread = [&](bool adds) {
      transform_.template to_modes<Count>(loops::TakeRestored<Dim, Count>{restore_.device(), modes, adds});
    };
    mesh_.template spread<Count>(value, weight_.device(), transform_.points(Count, Access::write));
    spread(false);
    Corrections left(corrections, uneven_);
    while (left.next()) {
      to_points<Count>(loops::Stored<Dim, Count>{modes});
      mesh_.template spread_missing<Count>(value, weight_.device(), transform_.points(Count, Access::read_write));
      spread(true);
    }
  }

  template <int Count, class Mode, class Take>
  void evaluate(const Mode& mode, const Take& take) {
    to_points<Count>(mode);
    mesh_.template gather<Count>(transform_.points(Count, exec::Access::read_write), take);
  }

 private:
  template <int Count, class Mode>
  void to_points(const Mode& mode) {
    transform_.template to_points<Count>(loops::Restoring<Dim, Count, Mode>{mode, restore_.device()});
  }

  // The one thing for which a step waits: how many corrections a fit takes goes by the unevenness.
  void weigh() {
    if (weighed_) return;
    const auto points = static_cast<Index>(kept_.grid().point_count());
    const double mean = static_cast<double>(mesh_.count()) / points;
    mesh_.find_weights(weight_.device(exec::Access::write));
    const auto [square, empty] = sum_(space_, points, loops::WeightOfPoint<Real>{weight_.device(), mean});
    if (std::isnan(square)) throw not_finite();
    uneven_ = std::sqrt(square / points) / mean;
    if (empty > 0.0) throw hardly_any_particle();
    weighed_ = true;
  }

  KeptModes<Dim> kept_;
  exec::Space space_;
  DeviceParticleMesh<Dim, Real> mesh_;
  DeviceModeTransform<Dim, Real> transform_;
  exec::Array<double> restore_;
  exec::Array<Real> weight_;  // of all particles at each point
  OrderedSum<2> sum_;
  bool weighed_ = false;
  double uneven_ = 0.0;
};

}  // namespace mesogen::mesh
