#pragma once

#include <array>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/field_reader.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen::mesh {

/// Nodes of a regular grid over a box in two dimensions.
struct Nodes {
  std::array<int, 2> count{};       ///< along each axis
  std::array<double, 2> spacing{};  ///< box / count, m
  std::array<double, 2> first{};    ///< coordinates of the first node, m
  std::vector<char> left_out{};     ///< by node, not 0: its mean is not wanted; empty: all are
};

/// Particles in the box: coordinates by axis, m, and a field of at least two components, in one order.
struct Carriers {
  const std::array<std::vector<double>, 2>& position;
  FieldReader field;
};

/// The first two components of a field at nodes, the first axis fastest: means of the particles around, weighted by the
/// kernel, f(x) = sum_j W(x - x_j) f_j / sum_j W(x - x_j) (Shepard 1968). Where no particle is near, it looks for some
/// farther out, with a wider kernel. What is not wanted is not a number. The order of the sums depends only on
/// positions and on the order of the particles.
MESOGEN_EXPORT std::vector<std::array<double, 2>> node_means(const Scene& scene, const Nodes& nodes,
                                                             const Carriers& particles,
                                                             const sph::SmoothingKernel& kernel);

}  // namespace mesogen::mesh
