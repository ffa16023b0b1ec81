#pragma once

#include "mesogen/sph/neighbours.hpp"
#include "sph/mirror_values.hpp"

/// How the runs of neighbours are found that sums on a device go by.
namespace mesogen::sph {

/// Of each segment around a point a run holds what lies between the first particle within reach and the last one.
/// `Lists`: writes these runs to run[at] and on; otherwise only counts them. Trivially copyable.
template <class Real, int Dim, bool Lists>
struct RunsAround {
  Neighbours<Real, Dim> grid;
  Real square_of_range;  // m2
  NeighbourRun* run;     // where they are listed

  /// `point`: relative to the tile of its cell, m. Returns one past the last run.
  MESOGEN_HOST_DEVICE Index find(const int (&cell)[Dim], const Real (&point)[Dim], Index at) const {
    grid.for_each_segment(cell, [&](const Segment<Real, Dim>& segment) {
      Index first = segment.end;
      Index end = segment.end;
      for (Index j = segment.begin; j < segment.end; ++j) {
        if (!is_within_reach(point, j, segment)) continue;
        if (first == segment.end) first = j;
        end = j + 1;
      }
      for (; first < end; first += NeighbourRun::longest) {
        if constexpr (Lists) run[at] = cut(segment, first, end);
        ++at;
      }
    });
    return at;
  }

 private:
  [[nodiscard]] MESOGEN_HOST_DEVICE bool is_within_reach(const Real (&point)[Dim], Index j,
                                                         const Segment<Real, Dim>& segment) const {
    Real square = Real(0);
    for (int d = 0; d < Dim; ++d) {
      const Real separation = point[d] - segment.offset[d] - grid.local[d][j];
      square += separation * separation;
    }
    return square <= square_of_range;
  }

  MESOGEN_HOST_DEVICE static NeighbourRun cut(const Segment<Real, Dim>& segment, Index first, Index end) {
    NeighbourRun made{};
    made.first = first;
    const Index count = end - first < NeighbourRun::longest ? end - first : NeighbourRun::longest;
    made.count = static_cast<std::uint8_t>(count);
    for (int d = 0; d < Dim; ++d) made.shift[d] = static_cast<std::int8_t>(segment.shift[d]);
    return made;
  }
};

/// The runs of particle i, from grid.run_begin[i] on, or their number. Trivially copyable.
template <class Real, int Dim, bool Lists>
struct FindRuns {
  Neighbours<Real, Dim> grid;
  Real square_of_range;  // m2
  Index* number;         // of the runs of each particle, where they are counted
  NeighbourRun* run;     // where they are listed

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    int cell[Dim];
    grid.cell_coordinates(grid.cell_of[i], cell);
    Real point[Dim];
    for (int d = 0; d < Dim; ++d) point[d] = grid.local[d][i];
    const RunsAround<Real, Dim, Lists> runs{grid, square_of_range, run};
    const Index end = runs.find(cell, point, Lists ? grid.run_begin[i] : 0);
    if constexpr (!Lists) number[i] = end;
  }
};

/// The same around the n-th mirror point.
template <class Real, int Dim, bool Lists>
struct FindMirrorRuns {
  Neighbours<Real, Dim> grid;
  MirrorPoints<Dim> points;
  Real square_of_range;
  Index* number;
  NeighbourRun* run;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    int cell[Dim];
    Real point[Dim];
    for (int d = 0; d < Dim; ++d) {
      cell[d] = points.cell[n][static_cast<std::size_t>(d)];
      point[d] = static_cast<Real>(points.local[d][n]);
    }
    const RunsAround<Real, Dim, Lists> runs{grid, square_of_range, run};
    const Index end = runs.find(cell, point, Lists ? points.run_begin[n] : 0);
    if constexpr (!Lists) number[n] = end;
  }
};

}  // namespace mesogen::sph
