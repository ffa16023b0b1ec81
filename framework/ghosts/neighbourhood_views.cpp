// What sums over pairs see of a neighbourhood.

#include "ghosts/neighbourhood.hpp"

namespace mesogen {

template <class Real, int Dim>
void Neighbourhood::fill(Neighbours<Real, Dim>& grid, exec::Side side) const {
  const bool by_blocks = side == exec::Side::host || backend_.has_host_code();
  grid.run_begin = by_blocks ? nullptr : run_begin_.on(side);
  grid.run = by_blocks ? nullptr : run_.on(side);
  for (int d = 0; d < Dim; ++d) {
    if constexpr (sizeof(Real) == sizeof(float)) {
      grid.local[d] = local_single_[d].on(side);
      grid.offset[d] = by_blocks ? blocks_.offset_single[d].data() : nullptr;
    } else {
      grid.local[d] = local_double_[d].on(side);
      grid.offset[d] = by_blocks ? blocks_.offset[d].data() : nullptr;
    }
    grid.cells[d] = grid_.cells(d);
    grid.padding[d] = grid_.padding(d);
    grid.reach[d] = grid_.reach(d);
    grid.wrapped[d] = grid_.wrapped(d);
    grid.width[d] = grid_.width(d);
  }
  grid.cell_begin = cell_begin_.on(side);
  grid.cell_end = cell_end_.on(side);
  grid.wall_begin = walls_->cell_begin(side);
  grid.wall_end = walls_->cell_end(side);
  grid.cell_of = cell_of_.on(side);
  grid.block_begin = by_blocks ? blocks_.begin.data() : nullptr;
  grid.block = by_blocks ? blocks_.block.data() : nullptr;
  grid.particle_count = static_cast<Index>(cell_of_.size());
  grid.tile = CellGrid::cells_in_tile;
  grid.radius = Real(scene_.support);
  const double h = scene_.smoothing_length;
  grid.smallest = Real((sizeof(Real) == sizeof(float) ? 1e-14 : 1e-30) * h * h);
}

template void Neighbourhood::fill(Neighbours<float, 2>&, exec::Side) const;
template void Neighbourhood::fill(Neighbours<double, 2>&, exec::Side) const;
template void Neighbourhood::fill(Neighbours<float, 3>&, exec::Side) const;
template void Neighbourhood::fill(Neighbours<double, 3>&, exec::Side) const;

}  // namespace mesogen
