#pragma once

#include <stdexcept>
#include <variant>

#include "mesogen/exec/sharing.hpp"
#include "mesogen/mesh/device_spectrum.hpp"
#include "mesogen/mesh/mode_loop.hpp"
#ifndef __CUDACC__
#include "mesogen/mesh/particle_spectrum.hpp"
#endif

namespace mesogen::mesh {

/// The ParticleSpectrum of a pass, where the pass runs: on the host, or on a device. Positions, values and modes lie
/// there too. Functors must be trivially copyable structs whose calls are MESOGEN_HOST_DEVICE.
template <int Dim, class Real = double>
class PassSpectrum {
 public:
  using WaveVector = typename KeptModes<Dim>::WaveVector;

  /// `device`: PassContext::device_mesh(). Throws std::logic_error if that is null in code that nvcc compiled.
  /// `sharing`: PassContext::sharing(). Throws Error(bad_case) where processes share a mesh on devices.
  PassSpectrum(const Grid<Dim>& grid, const DeviceMesh* device, const exec::Sharing* sharing = nullptr)
      : modes_(grid, device) {
    if (device != nullptr && sharing != nullptr) throw shared_on_devices();
    if (device != nullptr) {
      memory_ = &device->memory();
      space_ = device->space();
      form_.template emplace<DeviceSpectrum<Dim, Real>>(grid, *device);
    } else {
      make_on_host(grid, sharing);
    }
  }

  /// As ParticleSpectrum::bytes.
  static double bytes(const Grid<Dim>& grid, Index particles, int fitted, int evaluated) {
    return Compiled::bytes(grid, particles, fitted, evaluated);
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return modes_.kept().grid(); }
  [[nodiscard]] const KeptModes<Dim>& kept() const { return modes_.kept(); }
  [[nodiscard]] std::size_t mode_count() const { return grid().mode_count(); }
  /// Loops over modes.
  [[nodiscard]] ModeLoop<Dim>& modes() { return modes_; }
  /// Where exec::for_each loops over modes.
  [[nodiscard]] exec::Space space() const { return space_; }
  /// Where modes lie: arrays of them are to be made with it.
  [[nodiscard]] exec::DeviceMemory* memory() const { return memory_; }

  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    with_form([&](auto& form) { form.locate(position, count, origin); });
  }
  void unevenness(Complex* modes) {
    with_form([&](auto& form) { form.unevenness(modes); });
  }
  template <int Count, class Value>
  void fit(const Value& value, const std::array<Complex*, Count>& modes, int corrections) {
    with_form([&](auto& form) { form.template fit<Count>(value, modes, corrections); });
  }
  template <int Count, class Mode, class Take>
  void evaluate(const Mode& mode, const Take& take) {
    with_form([&](auto& form) { form.template evaluate<Count>(mode, take); });
  }
  /// Calls action(transform) with the ModeTransform, or that of the device.
  template <class Action>
  void with_transform(const Action& action) {
    with_form([&](auto& form) { action(form.transform()); });
  }

 private:
#ifdef __CUDACC__
  // What nvcc compiles runs only where there is a device.
  using Compiled = DeviceSpectrum<Dim, Real>;
  using Form = std::variant<std::monostate, DeviceSpectrum<Dim, Real>>;
  static void make_on_host(const Grid<Dim>&, const exec::Sharing*) {
    throw std::logic_error(
        "PassSpectrum is compiled for a device here, and was given none: it cannot work on the host");
  }
#else
  using Compiled = ParticleSpectrum<Dim, Real>;
  using Form = std::variant<std::monostate, DeviceSpectrum<Dim, Real>, ParticleSpectrum<Dim, Real>>;
  void make_on_host(const Grid<Dim>& grid, const exec::Sharing* sharing) {
    form_.template emplace<ParticleSpectrum<Dim, Real>>(grid, sharing);
  }
#endif

  template <class Action>
  void with_form(const Action& action) {
    if (auto* const device = std::get_if<1>(&form_)) action(*device);
#ifndef __CUDACC__
    if (auto* const host = std::get_if<2>(&form_)) action(*host);
#endif
  }

  exec::DeviceMemory* memory_ = nullptr;
  exec::Space space_;
  ModeLoop<Dim> modes_;
  Form form_;
};

}  // namespace mesogen::mesh
