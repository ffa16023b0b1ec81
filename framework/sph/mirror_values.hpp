#pragma once

#include <array>

#include "fields/rule_view.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/sph/neighbours.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

/// What a field is at the mirror points of walls, as rules of wall particles need it: by moving least squares with the
/// kernel of the run.
///
/// - Mostly it is interpolated at the mirror point, exactly where it is linear (S. Marrone et al., Comput. Methods in
///   Appl. Mech. and Engrg. 200, 1526 (2011)).
/// - A curved field has a value w at the wall: it is f = w + s l, with s the distance from the wall. The fit is of l, a
///   linear function, so that f is exact where it is quadratic. It is evaluated at the wall particle, at the distance
///   -d: f' = w - d l. What is handed out is y = w + d l, of which f' = 2 w - y is the reflection.
///   Of a vector this is the part along the wall. The normal part is interpolated: so the divergence of a velocity fits
///   the gradient of a pressure that is the same on both sides of the wall, and a fluid at rest stays so.
namespace mesogen::sph {

/// Points, and the particles around them: by blocks for code of the host, by runs for other code; see Neighbours. All
/// pointers are to where that code runs.
template <int Dim>
struct MirrorPoints {
  Index count;
  const double* local[Dim];    ///< relative to the tile of its cell, m
  const double* to_wall[Dim];  ///< from the point to the wall particle, m
  const double* normal[Dim];   ///< of the wall's surface between the two, into the fluid
  const double* curvature;     ///< likewise, 1/m; see WallParticle
  const std::array<int, 3>* cell;
  const double* offset[Dim];  ///< by shift of a block, as in Neighbours
  const std::int64_t* block_begin;
  const NeighbourBlock* block;
  const Index* run_begin;
  const NeighbourRun* run;
  const Index* row_begin;  ///< of each group of points; see mirror_runs.hpp
};

enum class MirrorFit { linear, curved };

/// Finds the weight of each particle at each point, lane by lane of its blocks, on the host; zero in lanes outside the
/// support. What weights of a curved field lack to 1 is the weight of the wall's own value. Where particles do not span
/// a linear function their weighted mean is taken.
template <class Real, int Dim>
MESOGEN_EXPORT void find_mirror_weights(MirrorFit fit, const Neighbours<Real, Dim>& neighbours,
                                        const MirrorPoints<Dim>& points, const SmoothingKernel& kernel, double* weight);

/// Weights of both fits; null where no rule needs them.
struct MirrorWeights {
  const double* linear = nullptr;
  const double* curved = nullptr;
};

/// Where a field is curved, and its values at the wall. Null: nowhere.
struct CurvedValues {
  bool along_wall = false;               ///< a vector: its normal part is not
  const std::uint8_t* curved = nullptr;  ///< by wall particle: 0 or 1
  const double* at_wall = nullptr;       ///< by wall particle, then component
};

/// Values of the n-th wall particle, at place first + n: those seen at the n-th point, then by the n-th rule. On the
/// host, by blocks.
template <class Real, int Dim>
MESOGEN_EXPORT void refresh_walls(const MirrorPoints<Dim>& points, const MirrorWeights& weights,
                                  const CurvedValues& curved, const RuleView& rules, FieldView<Real> field,
                                  int components, Index first);

}  // namespace mesogen::sph
