#pragma once

#include <type_traits>

#include "exec/reductions.hpp"
#include "neighbours/cell_grid.hpp"
#include "neighbours/cell_loops.hpp"
#include "particles/motion_loops.hpp"

/// The loops over particles and the cells that hold them, compiled twice: by g++ for the host, by nvcc for CUDA.
namespace mesogen::exec {

struct FindCell {
  CellGrid grid;
  const double* position[3];
  Index* cell;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    double at[3] = {0.0, 0.0, 0.0};
    for_axes(grid.dimension(), [&](int d) { at[d] = position[d][i]; });
    cell[i] = grid.number_of(at);
  }
};

/// The i-th particle ends all cells before its own that are not ended yet, and begins what follows them; one behind the
/// last ends the rest.
struct FindRanges {
  CellGrid grid;
  CellSpan cells;
  const Index* cell;
  Index count;
  Index* begin;
  Index* end;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const int first = i == 0 ? cells.first : cell[i - 1] + 1;
    const int last = i == count ? cells.end : cell[i];
    for (int c = first; c <= last; ++c) {
      if (c > cells.first) end[grid.padded_index_of(c - 1)] = i;
      if (c < cells.end) begin[grid.padded_index_of(c)] = i;
    }
  }
};

/// Places particles; where somebody looks, it raises if one has strayed too far. On the host all particles of a cell,
/// on a device one, so that threads which run together read numbers that lie together.
template <class Real>
struct PlaceParticles {
  CellGrid grid;
  PlaceArguments<Real> p;

#ifdef __CUDACC__
  [[nodiscard]] Index count() const { return p.count; }
#else
  [[nodiscard]] Index count() const { return p.cells.end - p.cells.first; }
#endif
  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    Maxima<1> nobody_looks{};
    place<false>(n, nobody_looks);
  }
  MESOGEN_HOST_DEVICE void operator()(Index n, Maxima<1>& strayed) const { place<true>(n, strayed); }

 private:
  template <bool Looks>
  MESOGEN_HOST_DEVICE void place(Index n, Maxima<1>& strayed) const {
#ifdef __CUDACC__
    const CellGrid::Cell cell = grid.inside(p.cell[n]);
    const Index first = n;
    const Index end = n + 1;
#else
    const CellGrid::Cell cell = grid.inside(p.cells.first + n);
    const int index = grid.padded_index(cell);
    const Index first = p.cell_begin[index];
    const Index end = p.cell_end[index];
#endif
    double origin[3] = {};
    for_axes(
        grid.dimension(), [&](auto d) __attribute__((always_inline)) { origin[d] = grid.tile_origin(d, cell[d]); });
    for (Index i = first; i < end; ++i) {
      double moved = 0.0;
      for_axes(
          grid.dimension(), [&](auto d) __attribute__((always_inline)) {
            const double at = p.position[d][i];
            p.local[d][i] = Real(at - origin[d]);
            if constexpr (Looks) moved += (at - p.sorted[d][i]) * (at - p.sorted[d][i]);
          });
      // Written so that NaN counts as having strayed; the guard after the step names it.
      if (Looks && !(moved <= p.farthest_square)) strayed.raise(0, 1.0);
    }
  }
};

template <class Real>
struct PlaceGhosts {
  int dimension;
  PlaceArguments<Real> p;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    for (int d = 0; d < dimension; ++d)
      p.local[d][p.ghosts.first + n] =
          Real(p.ghosts.position_of_source(p.position[d], d, n) + p.ghosts.offset[d][n] - p.ghosts.origin[d][n]);
  }
};

template <class Real>
struct PlaceWalls {
  int dimension;
  PlaceArguments<Real> p;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    for (int d = 0; d < dimension; ++d)
      p.local[d][p.walls.first + n] = Real(p.walls.position[d][n] - p.walls.origin[d][n]);
  }
};

#ifdef __CUDACC__
template <class Move, class Real>
struct MoveAndPlace {
  Move move;
  PlaceParticles<Real> place;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    move(i);
    place(i);
  }
};
#endif

/// All that can be written as loops over what is there: not how particles are put in order.
class CellLoopsImpl : public CellLoops {
 public:
  CellLoopsImpl(const Space& space, Reductions& reductions) : space_(space), reductions_(reductions) {}

  void find_cells(const CellGrid& grid, const double* const* position, Index count, Index* cell) const override {
    for_each(space_, count, FindCell{grid, {position[0], position[1], position[2]}, cell}, "finding cells");
  }
  void find_ranges(const CellGrid& grid, CellSpan cells, const Index* cell, Index count, Index* begin,
                   Index* end) const override {
    for_each(space_, count + 1, FindRanges{grid, cells, cell, count, begin, end}, "the particles of cells");
  }
  bool place(const CellGrid& grid, const PlaceArguments<float>& arguments) const override {
    return place_particles(grid, arguments);
  }
  bool place(const CellGrid& grid, const PlaceArguments<double>& arguments) const override {
    return place_particles(grid, arguments);
  }
  void move_and_place(const CellGrid& grid, const MoveArguments<float>& move,
                      const PlaceArguments<float>& place) const override {
    move_and_place_particles(grid, move, place);
  }
  void move_and_place(const CellGrid& grid, const MoveArguments<double>& move,
                      const PlaceArguments<double>& place) const override {
    move_and_place_particles(grid, move, place);
  }
  void move_and_place(const CellGrid& grid, const MoveByPassesArguments<float>& move,
                      const PlaceArguments<float>& place) const override {
    move_and_place_particles(grid, move, place);
  }
  void move_and_place(const CellGrid& grid, const MoveByPassesArguments<double>& move,
                      const PlaceArguments<double>& place) const override {
    move_and_place_particles(grid, move, place);
  }

 protected:
  [[nodiscard]] const Space& space() const { return space_; }

 private:
  template <class Real>
  bool place_particles(const CellGrid& grid, const PlaceArguments<Real>& arguments) const {
    constexpr const char* what = "placing particles";
    const PlaceParticles<Real> place{grid, arguments};
    if (arguments.looks) {
      const Reduction strayed = find_largest<1>(space_, reductions_, place.count(), place, what);
      reductions_.wait(space_);
      if (reductions_.found(strayed) > 0.0) return false;
    } else {
      for_each(space_, place.count(), place, what);
    }
    place_others(grid, arguments);
    return true;
  }
  template <class Real>
  void place_others(const CellGrid& grid, const PlaceArguments<Real>& arguments) const {
    for_each(space_, arguments.walls.count, PlaceWalls<Real>{grid.dimension(), arguments}, "placing walls");
    for_each(space_, arguments.ghosts.count, PlaceGhosts<Real>{grid.dimension(), arguments}, "placing ghosts");
  }
  template <class Moving, class Real>
  void move_and_place_particles(const CellGrid& grid, const Moving& arguments,
                                const PlaceArguments<Real>& place) const {
    constexpr const char* what = "moving and placing particles";
    const PlaceParticles<Real> placing{grid, place};
    with_move(arguments, [&](const auto& move) {
#ifdef __CUDACC__
      using Both = MoveAndPlace<std::decay_t<decltype(move)>, Real>;
      for_each(space_, place.count, Both{move, placing}, what);
#else
      for_each(space_, place.count, move, what);
      for_each(space_, placing.count(), placing, what);
#endif
    });
    place_others(grid, place);
  }

  Space space_;
  Reductions& reductions_;
};

}  // namespace mesogen::exec
