#pragma once

#include <vector>

#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/wall_surface.hpp"
#include "solids/fluid_region.hpp"

namespace mesogen {

/// The surfaces of all walls: faces of the box that are not periodic, as far as no solid hides them, then solids in the
/// order of the case. `boundary`: of the scene; `region`: null without solids.
std::vector<WallSurface> wall_surfaces(const Scene& scene, const Boundary& boundary, const FluidRegion* region);

}  // namespace mesogen
