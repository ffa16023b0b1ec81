#pragma once

#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen {

/// How large a field is at the start, and how distorted it is if it is an order tensor. Beyond walls it goes on as the
/// boundary says. The Laplacian is a scale, not a rate: particles have equal volumes and the sum is the plain one, so
/// that disorder of the particles counts as distortion too.
MESOGEN_EXPORT InitialExtent initial_extent(const FieldDeclaration& field, InitialState& state,
                                            const Boundary& boundary, const sph::SmoothingKernel& kernel);

}  // namespace mesogen
