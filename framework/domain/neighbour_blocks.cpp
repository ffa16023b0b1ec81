#include "domain/neighbour_blocks.hpp"

#include <omp.h>

#include <algorithm>
#include <numbers>

namespace mesogen {

namespace {

template <class Real, int Dim>
class Search {
 public:
  Search(const Neighbours<Real, Dim>& grid, double range) : grid_(grid), most_(Real(range * range)) {}

  /// Appends the blocks of particle i, whose neighbours lie in these segments.
  void find(Index i, const Segment<Real, Dim>* segments, int count, std::vector<NeighbourBlock>& out) const {
    for (int s = 0; s < count; ++s) {
      const Segment<Real, Dim>& segment = segments[s];
      Real at[Dim];
      for (int d = 0; d < Dim; ++d) at[d] = grid_.local[d][i] - segment.offset[d];
      Index first = segment.begin;
      while (first < segment.end && is_beyond(at, first)) ++first;
      if (first == segment.end) continue;
      Index last = segment.end - 1;
      while (last > first && is_beyond(at, last)) --last;
      NeighbourBlock block{};
      for (int d = 0; d < Dim; ++d) block.shift[d] = static_cast<std::int8_t>(segment.shift[d]);
      for (block.first = first; block.first <= last; block.first += NeighbourBlock::width<Real>) {
        block.lanes = static_cast<std::int8_t>(std::min<Index>(NeighbourBlock::width<Real>, last + 1 - block.first));
        out.push_back(block);
      }
    }
  }

 private:
  [[nodiscard]] bool is_beyond(const Real (&at)[Dim], Index j) const {
    Real square(0);
    for (int d = 0; d < Dim; ++d) square += (at[d] - grid_.local[d][j]) * (at[d] - grid_.local[d][j]);
    return square > most_;
  }

  const Neighbours<Real, Dim>& grid_;
  Real most_;
};

}  // namespace

template <class Real, int Dim>
void NeighbourBlocks::find(const Neighbours<Real, Dim>& grid, double range) {
  const Search<Real, Dim> search(grid, range);
  const int cells = grid.cell_count();
  for (int d = 0; d < Dim; ++d) {
    offset[d].clear();
    for (int shift = -NeighbourBlock::most_shift; shift <= NeighbourBlock::most_shift; ++shift)
      offset[d].push_back(shift * grid.width[d]);
    offset_single[d].assign(offset[d].begin(), offset[d].end());
  }
  begin.resize(static_cast<std::size_t>(grid.particle_count) + 1);
  std::vector<std::int64_t> part_begin;  // of what each thread finds
#pragma omp parallel
  {
#pragma omp single
    part_begin.assign(static_cast<std::size_t>(omp_get_num_threads()) + 1, 0);
    const auto part = static_cast<std::size_t>(omp_get_thread_num());
    std::vector<NeighbourBlock> found;
    Index first_particle = 0;
    Index last_particle = 0;  // one past it
                              // Each thread has cells, and so particles, that follow each other.
#pragma omp for schedule(static) nowait
    for (int cell = 0; cell < cells; ++cell) {
      int at[Dim];
      grid.cell_coordinates(cell, at);
      const int index = grid.cell_index(at);
      if (grid.cell_begin[index] == grid.cell_end[index]) continue;
      Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
      const int segments = grid.segments(at, segment);
      if (first_particle == last_particle) first_particle = grid.cell_begin[index];
      last_particle = grid.cell_end[index];
      for (Index i = grid.cell_begin[index]; i < last_particle; ++i) {
        begin[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(found.size());
        search.find(i, segment, segments, found);
      }
    }
    part_begin[part + 1] = static_cast<std::int64_t>(found.size());
#pragma omp barrier
#pragma omp single
    {
      for (std::size_t n = 1; n < part_begin.size(); ++n) part_begin[n] += part_begin[n - 1];
      block.resize(static_cast<std::size_t>(part_begin.back()));
      begin.back() = part_begin.back();
    }
    std::copy(found.begin(), found.end(), block.begin() + part_begin[part]);
    for (Index i = first_particle; i < last_particle; ++i) begin[static_cast<std::size_t>(i)] += part_begin[part];
  }
}

// Measured on lattices and on disordered particles: a tenth more than the disc, and half a block for each row that it
// meets.
double NeighbourBlocks::expected(double range, double row, int width) {
  const double rows = 2.0 * range / row + 1.0;
  return (1.1 * std::numbers::pi * range * range + rows * (width - 1.0) / 2.0) / width;
}

template void NeighbourBlocks::find(const Neighbours<float, 2>&, double);
template void NeighbourBlocks::find(const Neighbours<double, 2>&, double);
template void NeighbourBlocks::find(const Neighbours<float, 3>&, double);
template void NeighbourBlocks::find(const Neighbours<double, 3>&, double);

}  // namespace mesogen
