#pragma once

#include "exec/backend.hpp"
#include "exec/largest.hpp"
#include "neighbours/cell_grid.hpp"

/// Particles and the cells that hold them.
namespace mesogen::exec {

struct FindCell {
  CellGrid grid;
  const double* position[3];
  Index* cell;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    double at[3] = {0.0, 0.0, 0.0};
    for (int d = 0; d < grid.dimension(); ++d) at[d] = position[d][i];
    cell[i] = grid.number_of(at);
  }
};

/// The i-th particle ends all cells before its own that are not ended yet, and begins what follows them; one behind the
/// last ends the rest.
struct FindRanges {
  CellGrid grid;
  const Index* cell;
  Index count;
  Index* begin;
  Index* end;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const int first = i == 0 ? 0 : cell[i - 1] + 1;
    const int last = i == count ? grid.inside_count() : cell[i];
    for (int c = first; c <= last; ++c) {
      if (c > 0) end[grid.padded_index(grid.inside(c - 1))] = i;
      if (c < grid.inside_count()) begin[grid.padded_index(grid.inside(c))] = i;
    }
  }
};

/// The same of ghosts, which may lie in any cell.
struct FindGhostRanges {
  const Index* cell;
  Index count;
  Index first_place;
  int cells;
  Index* begin;
  Index* end;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const int first = n == 0 ? 0 : cell[n - 1] + 1;
    const int last = n == count ? cells : cell[n];
    for (int c = first; c <= last; ++c) {
      if (c > 0) end[c - 1] = first_place + n;
      if (c < cells) begin[c] = first_place + n;
    }
  }
};

/// Places the particles of a cell; raises above zero if one has strayed too far.
template <class Real>
struct PlaceParticles {
  CellGrid grid;
  Placing<Real> p;

  MESOGEN_HOST_DEVICE void operator()(Index c, Maxima<1>& strayed) const {
    const CellGrid::Cell cell = grid.inside(c);
    const int index = grid.padded_index(cell);
    double origin[3];
    for (int d = 0; d < grid.dimension(); ++d) origin[d] = grid.tile_origin(d, cell[d]);
    for (Index i = p.cell_begin[index]; i < p.cell_end[index]; ++i) {
      double moved = 0.0;
      for (int d = 0; d < grid.dimension(); ++d) {
        const double at = p.position[d][i];
        const double by = at - p.sorted[d][i];
        moved += by * by;
        p.local[d][i] = Real(at - origin[d]);
      }
      // Written so that NaN counts as having strayed; the guard after the step names it.
      if (!(moved <= p.farthest_square)) strayed.value[0] = 1.0;
    }
  }
};

}  // namespace mesogen::exec
