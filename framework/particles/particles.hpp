#pragma once

#include <cstdint>

#include "mesogen/exec/array.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// Where particles are and which they are, in storage order. Coordinates are doubles in any precision of the run: a
/// step moves a particle by less than float resolves.
struct Particles {
  explicit Particles(exec::DeviceMemory* memory = nullptr)
      : position(exec::axis_arrays<double>(memory)), images(exec::axis_arrays<std::int32_t>(memory)), id(memory) {}

  int dimension = 0;                      ///< of space
  exec::AxisArrays<double> position;      ///< m
  exec::AxisArrays<std::int32_t> images;  ///< boxes crossed along each axis
  exec::Array<std::int64_t> id;

  [[nodiscard]] Index count() const { return static_cast<Index>(id.size()); }
};

}  // namespace mesogen
