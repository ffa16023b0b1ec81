#pragma once

#include "mesogen/exec/for_each.hpp"
#include "sph/mirror_values.hpp"

/// Values at mirror points for code that goes by runs, that of a device: one thread per point. It finds what
/// mirror_values.hpp says, up to rounding. Runs of a point, and particles of a run, are summed in their order.
namespace mesogen::sph {

/// Where the weights of runs lie. 32 points that follow each other are a group, for a warp. Row k of a group holds the
/// weights of the k-th particle of each of its points, side by side; a group has as many rows as the point among them
/// that sees most particles. So threads of a warp read neighbouring numbers.
struct MirrorRows {
  static constexpr Index width = 32;
  [[nodiscard]] static constexpr Index groups(Index points) { return points / width + (points % width == 0 ? 0 : 1); }
  /// How many numbers so many rows hold.
  [[nodiscard]] static constexpr std::size_t size(Index rows) { return static_cast<std::size_t>(rows) * width; }
};

/// How many runs the particles within `range` (m) of each point make.
template <class Real, int Dim>
MESOGEN_EXPORT void count_mirror_runs(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                                      const MirrorPoints<Dim>& points, double range, Index* number);
/// Writes these runs to `run`, those of a point from points.run_begin on.
template <class Real, int Dim>
MESOGEN_EXPORT void list_mirror_runs(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                                     const MirrorPoints<Dim>& points, double range, NeighbourRun* run);
/// How many rows each group of points has.
template <int Dim>
MESOGEN_EXPORT void count_mirror_rows(const exec::Space& space, const MirrorPoints<Dim>& points, Index* number);

/// As by blocks, but for where weights lie.
template <class Real, int Dim>
MESOGEN_EXPORT void find_mirror_weights(const exec::Space& space, MirrorFit fit,
                                        const Neighbours<Real, Dim>& neighbours, const MirrorPoints<Dim>& points,
                                        const SmoothingKernel& kernel, double* weight);
template <class Real, int Dim>
MESOGEN_EXPORT void refresh_walls(const exec::Space& space, const MirrorPoints<Dim>& points,
                                  const MirrorWeights& weights, const CurvedValues& curved, const RuleView& rules,
                                  FieldView<Real> field, int components, Index first);

}  // namespace mesogen::sph
