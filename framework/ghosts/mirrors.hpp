#pragma once

#include <array>
#include <vector>

#include "exec/backend.hpp"
#include "ghosts/wall_set.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/neighbours.hpp"
#include "neighbours/cell_grid.hpp"
#include "neighbours/neighbour_blocks.hpp"
#include "sph/mirror_values.hpp"

namespace mesogen {

/// The mirror points of all wall particles, which never move, and the particles and ghosts of the fluid around them, as
/// they were at the last sorting: by blocks, or by runs for a backend without code of the host.
class MESOGEN_EXPORT Mirrors {
 public:
  /// The n-th is that of walls[n].
  Mirrors(const Scene& scene, const Boundary& boundary, const CellGrid& grid, const std::vector<WallSet::Member>& walls,
          const Backend& backend);

  /// On which side the particles around them are looked for, and values are found.
  [[nodiscard]] exec::Side side() const { return backend_.has_host_code() ? exec::Side::host : exec::Side::device; }
  /// `grid` is for that side; `range`: how far around a point particles are kept, m.
  template <class Real, int Dim>
  void find(Neighbours<Real, Dim> grid, double range);

  /// As that side sees them.
  template <int Dim>
  [[nodiscard]] sph::MirrorPoints<Dim> points() const;
  /// How many weights there are of all that is around them.
  template <class Real>
  [[nodiscard]] std::size_t weights() const;

 private:
  template <class Real, int Dim>
  void find_runs(const Neighbours<Real, Dim>& grid, double range);

  const Backend& backend_;
  exec::Array<CellGrid::Cell> cell_;
  exec::AxisArrays<double> local_;  // relative to the tile of the cell
  exec::AxisArrays<double> to_wall_;
  exec::AxisArrays<double> normal_;
  exec::Array<double> curvature_;
  NeighbourBlocks blocks_;
  exec::Array<Index> run_begin_;  // by point, one more at the end
  exec::Array<NeighbourRun> run_;
  exec::Array<Index> row_begin_;  // by group of points, likewise
  Index rows_ = 0;
};

}  // namespace mesogen
