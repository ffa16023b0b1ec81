#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/field/view.hpp"

namespace mesogen {

/// Where particles are and which they are, in storage order. Coordinates are doubles in any precision of the run: a
/// step moves a particle by less than float resolves.
struct MESOGEN_EXPORT Particles {
  int dimension = 2;
  std::array<std::vector<double>, 3> position;      ///< m
  std::array<std::vector<std::int32_t>, 3> images;  ///< boxes crossed along each axis
  std::vector<std::int64_t> id;

  [[nodiscard]] Index count() const { return static_cast<Index>(id.size()); }
};

}  // namespace mesogen
