#pragma once

#include <array>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen {

/// How distorted an order tensor is: `tensor` has (Q11, Q12) of each particle, `position` where the particles are, m.
/// Beyond walls the tensor goes on as the boundary says. For a scale, not for a rate: particles of equal volumes and
/// the plain Laplacian, so that disorder of the particles counts as distortion too.
MESOGEN_EXPORT Distortion distortion_of(const std::array<std::vector<double>, 2>& tensor,
                                        const std::array<std::vector<double>, 3>& position, const Scene& scene,
                                        const Boundary& boundary, const sph::SmoothingKernel& kernel);

}  // namespace mesogen
