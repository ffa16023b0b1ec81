#pragma once

#include <string>
#include <vector>

#include "mesogen/plugin/scene.hpp"
#include "solids/fluid_region.hpp"
#include "solids/packing.hpp"

namespace mesogen {

/// What is wrong with the solids of a case: no fluid is left, one touches no fluid, the gap between two is too narrow,
/// or they cut off a pocket of fluid. Empty if nothing is. `length_unit`: of the case.
std::string fit_problem(const FluidRegion& region, const Scene& scene, const Packing& packing,
                        const std::string& length_unit);

}  // namespace mesogen
