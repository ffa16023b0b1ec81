#include "run/closest_pair.hpp"

#include <algorithm>
#include <cmath>

#include "mesogen/exec/dispatch.hpp"

namespace mesogen {

namespace {

/// Calls visit(j, squared distance) for every j in the cells around particle i of a cell.
template <class Real, int Dim, class Visit>
void visit_around(const Neighbours<Real, Dim>& grid, const Segment<Real, Dim>* segments, int count, Index i,
                  const Visit& visit) {
  for (int s = 0; s < count; ++s) {
    Real at[Dim];
    for (int d = 0; d < Dim; ++d) at[d] = grid.local[d][i] - segments[s].offset[d];
    for (Index j = segments[s].begin; j < segments[s].end; ++j) {
      Real square = Real(0);
      for (int d = 0; d < Dim; ++d) {
        const Real distance = at[d] - grid.local[d][j];
        square += distance * distance;
      }
      if (j != i) visit(j, square);
    }
  }
}

template <class Real, int Dim>
std::optional<ClosestPair> closest_pair_of(const State& state, double within) {
  Neighbours<Real, Dim> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  // A wall is for nobody to pair with.
  grid.wall_begin = grid.wall_end = nullptr;
  // The grid is made for the support; only the next cells matter here. Until they are sorted anew two particles stand
  // up to half a skin outside their cells, each.
  for (int d = 0; d < Dim; ++d)
    grid.reach[d] =
        std::min(grid.reach[d], static_cast<int>(std::ceil((within + state.neighbourhood.skin()) / grid.width[d])));
  const auto in_cell = [&grid](int cell, const auto& action) {
    int at[Dim];
    grid.cell_coordinates(cell, at);
    const int index = grid.cell_index(at);
    if (grid.cell_begin[index] == grid.cell_end[index] || grid.cell_begin[index] >= grid.particle_count) return;
    Segment<Real, Dim> segments[Neighbours<Real, Dim>::most_segments];
    const int count = grid.segments(at, segments);
    for (Index i = grid.cell_begin[index]; i < grid.cell_end[index]; ++i) action(i, segments, count);
  };
  const GhostView ghosts = state.neighbourhood.ghost_view(exec::Side::host);
  const int cells = grid.cell_count();
  Real closest = Real(within * within);
  const Real limit = closest;
#pragma omp parallel for schedule(static) reduction(min : closest)
  for (int cell = 0; cell < cells; ++cell)
    in_cell(cell, [&](Index i, const Segment<Real, Dim>* segments, int count) {
      visit_around(grid, segments, count, i, [&](Index, Real square) { closest = std::min(closest, square); });
    });
  if (!(closest < limit)) return std::nullopt;

  // Now which they are: only once in the life of a run.
  ClosestPair pair{-1, -1, within};
  Real least = limit;
  for (int cell = 0; cell < cells; ++cell)
    in_cell(cell, [&](Index i, const Segment<Real, Dim>* segments, int count) {
      visit_around(grid, segments, count, i, [&](Index j, Real square) {
        if (!(square < least)) return;
        least = square;
        pair = {i, j < ghosts.first ? j : ghosts.place_of_source(j - ghosts.first),
                std::sqrt(static_cast<double>(square))};
      });
    });
  // The compiler may round the two loops differently.
  if (pair.a < 0) return std::nullopt;
  return pair;
}

}  // namespace

std::optional<ClosestPair> closest_pair(const State& state, double within) {
  return dispatch(state.scene.precision, state.scene.dimension,
                  [&]<class Real, int Dim>() { return closest_pair_of<Real, Dim>(state, within); });
}

}  // namespace mesogen
