#pragma once

#include <vector>

#include "case/arrangement.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "solids/fluid_region.hpp"

namespace mesogen {

/// Particles on both sides of the surface of the fluid.
struct Packing {
  std::vector<Shape::Point> fluid;
  std::vector<Shape::Point> solid;  ///< as deep in it as the fluid sees
};

/// Places particles between solids: those of a lattice are told apart by the side on which they lie, and then moved
/// apart until they are evenly spread, with the first row on either side half a spacing from the surface. Far from all
/// surfaces the lattice stays as it is.
///
/// Each moves away from its neighbours as if they diffused, delta x = - D grad C with C = sum_j V W_ij (S. J. Lind et
/// al., J. Comput. Phys. 231, 1499 (2012)), and is put back where it comes too near to the surface.
///
/// `behind_faces`: particles of walls at the faces of the box. `reach`: how far the fluid sees, m.
MESOGEN_EXPORT Packing pack(const FluidRegion& region, const Scene& scene, const Arrangement& lattice,
                            const std::vector<Shape::Point>& behind_faces, double reach);

}  // namespace mesogen
