#pragma once

#include "fields/rule_view.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/sph/neighbours.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

/// What a field is at the mirror points of walls: interpolated by moving least squares with the kernel of the run,
/// exact where the field is linear (S. Marrone et al., Comput. Methods Appl. Mech. Engrg. 200, 1526 (2011)).
namespace mesogen::sph {

/// Points, and the particles around them by blocks; see Neighbours. On the host.
template <int Dim>
struct MirrorPoints {
  Index count;
  const double* local[Dim];   ///< relative to the tile of its cell, m
  const double* offset[Dim];  ///< by shift of a block, as in Neighbours
  const std::int64_t* block_begin;
  const NeighbourBlock* block;
};

/// Finds the weight of each particle at each point, lane by lane of its blocks; zero in lanes outside the support.
/// Where particles do not span a linear function their weighted mean is taken.
template <class Real, int Dim>
MESOGEN_EXPORT void find_mirror_weights(const Neighbours<Real, Dim>& neighbours, const MirrorPoints<Dim>& points,
                                        const SmoothingKernel& kernel, double* weight);

/// Values of the n-th wall particle, at place first + n: interpolated at the n-th point, then by the n-th rule.
template <class Real, int Dim>
MESOGEN_EXPORT void refresh_walls(const MirrorPoints<Dim>& points, const double* weight, const RuleView& rules,
                                  FieldView<Real> field, int components, Index first);

}  // namespace mesogen::sph
