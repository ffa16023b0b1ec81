#pragma once

#include <array>
#include <cstdint>

#include "exec/memory.hpp"
#include "mesogen/export.hpp"
#include "mesogen/particles/field_view.hpp"

namespace mesogen {

/// Where particles are and which they are, in storage order. Coordinates are doubles in any precision of the run: a
/// step moves a particle by less than float resolves.
struct MESOGEN_EXPORT Particles {
  explicit Particles(exec::Memory& memory = exec::Memory::host())
      : position{exec::Array<double>(memory), exec::Array<double>(memory), exec::Array<double>(memory)},
        images{exec::Array<std::int32_t>(memory), exec::Array<std::int32_t>(memory), exec::Array<std::int32_t>(memory)},
        id(memory) {}

  int dimension = 0;                                ///< of space
  std::array<exec::Array<double>, 3> position;      ///< m
  std::array<exec::Array<std::int32_t>, 3> images;  ///< boxes crossed along each axis
  exec::Array<std::int64_t> id;

  [[nodiscard]] Index count() const { return static_cast<Index>(id.size()); }
};

}  // namespace mesogen
