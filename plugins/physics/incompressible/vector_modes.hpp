#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "mesogen/exec/array.hpp"
#include "mesogen/mesh/complex.hpp"

namespace mesogen::incompressible {

using mesh::Complex;

/// All modes of a vector, component after component, where the passes run.
template <int Dim>
class VectorModes {
 public:
  VectorModes(std::size_t mode_count, exec::DeviceMemory* memory) : mode_count_(mode_count), all_(memory) {
    all_.resize(Dim * mode_count);
  }

  [[nodiscard]] std::array<const Complex*, Dim> read() const {
    std::array<const Complex*, Dim> modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = all_.device() + static_cast<std::size_t>(d) * mode_count_;
    return modes;
  }
  /// Those that are not written keep their values.
  [[nodiscard]] std::array<Complex*, Dim> write() {
    std::array<Complex*, Dim> modes{};
    for (int d = 0; d < Dim; ++d)
      modes[d] = all_.device(exec::Access::read_write) + static_cast<std::size_t>(d) * mode_count_;
    return modes;
  }
  /// On the host: real and imaginary part of each.
  [[nodiscard]] std::span<double> numbers() {
    const auto modes = all_.host(exec::Access::read_write);
    return {reinterpret_cast<double*>(modes.data()), 2 * modes.size()};
  }
  void move_to(exec::DeviceMemory* memory) {
    exec::Array<Complex> there(memory);
    there = all_;
    all_.swap(there);
  }

 private:
  std::size_t mode_count_;
  exec::Array<Complex> all_;
};

}  // namespace mesogen::incompressible
