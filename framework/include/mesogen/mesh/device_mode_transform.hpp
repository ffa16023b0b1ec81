#pragma once

#include <array>
#include <memory>

#include "mesogen/exec/array.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/mesh/device_mesh.hpp"
#include "mesogen/mesh/mode_list.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

template <int Dim, class Real, int Count, class Mode>
struct FillModes {
  ModeList<Dim> list;
  Mode mode;
  ComplexNumber<Real>* to;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    mesh::Mode<Dim> at{};
    Complex numbers[Count];
    if (list.find(n, at)) mode(at.n, at.k, numbers);
    exec::unroll<Count>(
        [&](auto c) { to[static_cast<std::ptrdiff_t>(c) * list.stored() + n] = ComplexNumber<Real>(numbers[c]); });
  }
};

template <int Dim, class Real, int Count, class Take>
struct TakeModes {
  ModeList<Dim> list;
  Take take;
  const ComplexNumber<Real>* from;
  double factor;

  MESOGEN_HOST_DEVICE void operator()(Index j) const {
    const mesh::Mode<Dim> at = list[j];
    Complex numbers[Count];
    exec::unroll<Count>([&](auto c) {
      numbers[c] = factor * Complex(from[static_cast<std::size_t>(c) * static_cast<std::size_t>(list.stored()) + at.n]);
    });
    take(at.n, at.k, numbers);
  }
};

template <class Real, int From, int To, class Change>
struct ChangePoint {
  Change change;
  Real* points;
  Index all;

  MESOGEN_HOST_DEVICE void operator()(Index point) const {
    Real before[From];
    Real after[To];
    exec::unroll<From>([&](auto c) { before[c] = points[static_cast<std::ptrdiff_t>(c) * all + point]; });
    change(before, after);
    exec::unroll<To>([&](auto c) { points[static_cast<std::ptrdiff_t>(c) * all + point] = after[c]; });
  }
};

}  // namespace loops

/// A ModeTransform on a device. All functors must be trivially copyable and run on a device.
template <int Dim, class Real>
class DeviceModeTransform {
 public:
  using Number = ComplexNumber<Real>;

  DeviceModeTransform(const KeptModes<Dim>& kept, const DeviceMesh& device)
      : list_(kept),
        points_in_field_(kept.grid().point_count()),
        modes_in_field_(kept.grid().mode_count()),
        space_(device.space()),
        transform_(device.transform<Real>(kept.grid())),
        points_(&device.memory()),
        modes_(&device.memory()) {}

  /// The values of `fields` fields at the points, field after field without gaps.
  [[nodiscard]] Real* points(int fields, exec::Access access) {
    hold(points_, static_cast<std::size_t>(fields) * points_in_field_);
    return points_.device(access);
  }

  /// As ModeTransform::to_points.
  template <int Count, class Mode>
  void to_points(const Mode& mode) {
    hold(modes_, Count * modes_in_field_);
    auto* const modes = modes_.device(exec::Access::write);
    exec::for_each(space_, list_.stored(), loops::FillModes<Dim, Real, Count, Mode>{list_, mode, modes},
                   "modes for the mesh");
    transform_->backward(modes, points(Count, exec::Access::write), Count);
  }

  /// As ModeTransform::to_modes.
  template <int Count, class Take>
  void to_modes(const Take& take) {
    hold(modes_, Count * modes_in_field_);
    transform_->forward(points_.device(), modes_.device(exec::Access::write), Count);
    exec::for_each(space_, list_.count(),
                   loops::TakeModes<Dim, Real, Count, Take>{list_, take, modes_.device(),
                                                            1.0 / static_cast<double>(points_in_field_)},
                   "modes of the mesh");
  }

  /// As ModeTransform::hold.
  void hold_points(int fields) { hold(points_, static_cast<std::size_t>(fields) * points_in_field_); }
  /// As ModeTransform::change_points.
  template <int From, int To, class Change>
  void change_points(const Change& change) {
    const auto all = static_cast<Index>(points_in_field_);
    exec::for_each(space_, all,
                   loops::ChangePoint<Real, From, To, Change>{change, points_.device(exec::Access::read_write), all},
                   "points of the mesh");
  }

 private:
  template <class T>
  static void hold(exec::Array<T>& array, std::size_t size) {
    if (array.size() < size) array.resize_for_overwrite(size);
  }

  ModeList<Dim> list_;
  std::size_t points_in_field_;
  std::size_t modes_in_field_;
  exec::Space space_;
  std::unique_ptr<DeviceTransform<Real>> transform_;
  exec::Array<Real> points_;
  exec::Array<Number> modes_;
};

}  // namespace mesogen::mesh
