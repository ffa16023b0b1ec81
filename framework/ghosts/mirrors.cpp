#include "ghosts/mirrors.hpp"

#include "neighbours/cell_loops.hpp"
#include "plugin/way_to_mirror.hpp"
#include "sph/mirror_loops.hpp"

namespace mesogen {

using exec::Access;

Mirrors::Mirrors(const Scene& scene, const Boundary& boundary, const CellGrid& grid,
                 const std::vector<WallSet::Member>& walls, const Backend& backend)
    : backend_(backend),
      cell_(backend.memory()),
      local_(exec::axis_arrays<double>(backend.memory())),
      to_wall_(exec::axis_arrays<double>(backend.memory())),
      normal_(exec::axis_arrays<double>(backend.memory())),
      curvature_(backend.memory()),
      run_begin_(backend.memory()),
      run_(backend.memory()),
      row_begin_(backend.memory()) {
  std::vector<CellGrid::Cell> cell;
  std::vector<double> curvature;
  std::array<std::vector<double>, 3> local;
  std::array<std::vector<double>, 3> to_wall;
  std::array<std::vector<double>, 3> normal;
  for (const WallSet::Member& wall : walls) {
    curvature.push_back(wall.particle.curvature);
    cell.push_back(grid.nearest_inside(wall.particle.mirror));
    const std::array<double, 3> way = way_to_mirror(scene, boundary, wall.particle);
    for (int d = 0; d < scene.dimension; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      local[axis].push_back(wall.particle.mirror[axis] - grid.tile_origin(d, cell.back()[axis]));
      to_wall[axis].push_back(-way[axis]);
      normal[axis].push_back(wall.particle.normal[axis]);
    }
  }
  cell_.assign(cell);
  curvature_.assign(curvature);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    local_[axis].assign(local[axis]);
    to_wall_[axis].assign(to_wall[axis]);
    normal_[axis].assign(normal[axis]);
  }
}

template <class Real, int Dim>
void Mirrors::find(Neighbours<Real, Dim> grid, double range) {
  if (cell_.empty()) return;
  grid.wall_begin = grid.wall_end = nullptr;  // a mirror point sees the fluid alone
  if (!backend_.has_host_code()) return find_runs(grid, range);
  blocks_.find_around(grid, exec::pointers(local_, exec::Side::host), cell_.host(), range);
}

template <class Real, int Dim>
void Mirrors::find_runs(const Neighbours<Real, Dim>& grid, double range) {
  const exec::MirrorLoops<Real>& loops = backend_.mirrors<Real>();
  const auto count = static_cast<Index>(cell_.size());
  run_begin_.resize_for_overwrite(cell_.size() + 1);
  loops.count_runs(grid, points<Dim>(), range, run_begin_.device(Access::write));
  run_.resize_for_overwrite(
      static_cast<std::size_t>(backend_.cells().running_sums(run_begin_.device(Access::read_write), count)));
  NeighbourRun* const run = run_.device(Access::write);
  loops.list_runs(grid, points<Dim>(), range, run);
  const Index groups = sph::MirrorRows::groups(count);
  row_begin_.resize_for_overwrite(static_cast<std::size_t>(groups) + 1);
  Index* const rows = row_begin_.device(Access::write);
  loops.count_rows(points<Dim>(), rows);
  rows_ = backend_.cells().running_sums(row_begin_.device(Access::read_write), groups);
}

template <int Dim>
sph::MirrorPoints<Dim> Mirrors::points() const {
  sph::MirrorPoints<Dim> points{};
  points.count = static_cast<Index>(cell_.size());
  points.cell = cell_.on(side());
  points.curvature = curvature_.on(side());
  for (int d = 0; d < Dim; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    points.local[d] = local_[axis].on(side());
    points.to_wall[d] = to_wall_[axis].on(side());
    points.normal[d] = normal_[axis].on(side());
    points.offset[d] = blocks_.offset[axis].data();
  }
  points.block_begin = blocks_.begin.data();
  points.block = blocks_.block.data();
  points.run_begin = run_begin_.on(side());
  points.run = run_.on(side());
  points.row_begin = row_begin_.on(side());
  return points;
}
template sph::MirrorPoints<2> Mirrors::points() const;
template sph::MirrorPoints<3> Mirrors::points() const;

template <class Real>
std::size_t Mirrors::weights() const {
  if (!backend_.has_host_code()) return sph::MirrorRows::size(rows_);
  return static_cast<std::size_t>(blocks_.begin.back()) * NeighbourBlock::width<Real>;
}
template std::size_t Mirrors::weights<float>() const;
template std::size_t Mirrors::weights<double>() const;

template void Mirrors::find(Neighbours<float, 2>, double);
template void Mirrors::find(Neighbours<double, 2>, double);

}  // namespace mesogen
