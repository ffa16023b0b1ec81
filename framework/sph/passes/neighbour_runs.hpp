#pragma once

#include "mesogen/sph/neighbours.hpp"

/// How the runs of neighbours are found that pair sums on a device go by.
namespace mesogen::sph {

/// Of each segment around particle i a run holds what lies between the first particle within reach and the last one.
/// `Lists`: writes the runs of particle i from grid.run_begin[i] on; otherwise counts them. Trivially copyable.
template <class Real, int Dim, bool Lists>
struct FindRuns {
  Neighbours<Real, Dim> grid;
  Real square_of_range;  // m2
  Index* number;         // of the runs of each particle, where they are counted
  NeighbourRun* run;     // where they are listed

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    int cell[Dim];
    grid.cell_coordinates(grid.cell_of[i], cell);
    Index at = Lists ? grid.run_begin[i] : 0;
    grid.for_each_segment(cell, [&](const Segment<Real, Dim>& segment) {
      Index first = segment.end;
      Index end = segment.end;
      for (Index j = segment.begin; j < segment.end; ++j) {
        if (!is_within_reach(i, j, segment)) continue;
        if (first == segment.end) first = j;
        end = j + 1;
      }
      for (; first < end; first += NeighbourRun::longest) {
        if constexpr (Lists) run[at] = cut(segment, first, end);
        ++at;
      }
    });
    if constexpr (!Lists) number[i] = at;
  }

 private:
  [[nodiscard]] MESOGEN_HOST_DEVICE bool is_within_reach(Index i, Index j, const Segment<Real, Dim>& segment) const {
    Real square = Real(0);
    for (int d = 0; d < Dim; ++d) {
      const Real separation = grid.local[d][i] - segment.offset[d] - grid.local[d][j];
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

}  // namespace mesogen::sph
