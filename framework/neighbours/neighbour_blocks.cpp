#include "neighbours/neighbour_blocks.hpp"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesogen/exec/lanes.hpp"

namespace mesogen {

namespace {

template <class Real, int Dim>
class Search {
  using Lane = exec::Pack<Real>;
  static constexpr int lanes = static_cast<int>(Lane::size());

 public:
  Search(const Neighbours<Real, Dim>& grid, double range) : grid_(grid), most_(Real(range * range)) {
    std::fill_n(beyond_, lanes, Real(0));
    std::fill_n(beyond_ + lanes, lanes, std::numeric_limits<Real>::infinity());
  }

  // Blocks are written where they stay: to copy one whose bytes were just written, the processor has to wait for them.

  /// Appends the blocks around a point, relative to its tile, whose neighbours lie in these segments, each of one run.
  void find(const Real (&point)[Dim], const Segment<Real, Dim>* segments, int count,
            std::vector<NeighbourBlock>& found) const {
    for (int s = 0; s < count; ++s) {
      auto [first, end] = within_reach(point, segments[s]);
      while (first < end) begin_block(segments[s], first, end, found.emplace_back());
    }
  }

  /// The same with two runs a block wherever its lanes are not all taken by one.
  void find_by_two(const Real (&point)[Dim], const Segment<Real, Dim>* segments, int count,
                   std::vector<NeighbourBlock>& found) const {
    NeighbourBlock* open = nullptr;  // the last, if it has one run and lanes free
    for (int s = 0; s < count; ++s) {
      auto [first, end] = within_reach(point, segments[s]);
      if (first < end && open != nullptr && segments[s].shift[0] == open->shift[0]) {
        add_second(segments[s], first, end, *open);
        open = nullptr;
      }
      while (first < end) {
        NeighbourBlock& block = found.emplace_back();
        begin_block(segments[s], first, end, block);
        open = block.lanes < width ? &block : nullptr;
      }
    }
  }

 private:
  static constexpr Index width = NeighbourBlock::width<Real>;

  /// Puts as much of the run [first, end) as it holds into a block; `first` moves behind that.
  static void begin_block(const Segment<Real, Dim>& segment, Index& first, Index end, NeighbourBlock& block) {
    block.first = block.second = first;
    block.lanes = block.split = static_cast<std::int8_t>(std::min(width, end - first));
    for (int d = 0; d < Dim; ++d) block.shift[d] = block.second_shift[d] = static_cast<std::int8_t>(segment.shift[d]);
    first += block.lanes;
  }
  static void add_second(const Segment<Real, Dim>& segment, Index& first, Index end, NeighbourBlock& block) {
    const Index added = std::min(width - block.lanes, end - first);
    block.second = first - block.lanes;
    for (int d = 0; d < Dim; ++d) block.second_shift[d] = static_cast<std::int8_t>(segment.shift[d]);
    block.lanes = static_cast<std::int8_t>(block.lanes + added);
    first += added;
  }

  /// From the first particle of a segment that is near enough to one past the last.
  [[nodiscard]] std::pair<Index, Index> within_reach(const Real (&point)[Dim],
                                                     const Segment<Real, Dim>& segment) const {
    Lane at[Dim];
    for (int d = 0; d < Dim; ++d) at[d] = Lane(point[d] - segment.offset[d]);
    Index first = segment.end;
    Index end = segment.end;
    for (Index j = segment.begin; j < segment.end; j += lanes) {
      // Of lanes past the end of the segment nobody knows what they hold.
      Lane square;
      exec::load(beyond_ + std::max<Index>(0, lanes - (segment.end - j)), square);
      for (int d = 0; d < Dim; ++d) {
        Lane local;
        exec::load(grid_.local[d] + j, local);
        square = square + (at[d] - local) * (at[d] - local);
      }
      const auto near = square <= most_;
      if (exec::stdx::none_of(near)) continue;
      if (first == segment.end) first = j + exec::stdx::find_first_set(near);
      end = std::min<Index>(segment.end, j + exec::stdx::find_last_set(near) + 1);
    }
    return {first, end};
  }

  const Neighbours<Real, Dim>& grid_;
  Real most_;
  Real beyond_[2 * lanes];  // 0, then infinite
};

/// Blocks have two runs only where a pack holds a block.
template <class Real>
constexpr bool by_two = exec::Pack<Real>::size() == NeighbourBlock::width<Real>;

}  // namespace

template <class Real, int Dim>
void NeighbourBlocks::find(const Neighbours<Real, Dim>& grid, double range) {
  const Search<Real, Dim> search(grid, range);
  const int cells = grid.cell_count();
  find_offsets(grid.width, Dim);
  begin.resize(static_cast<std::size_t>(grid.particle_count) + 1);
  std::vector<std::int64_t> part_begin;  // of what each thread finds
#pragma omp parallel
  {
#pragma omp single
    part_begin.assign(static_cast<std::size_t>(omp_get_num_threads()) + 1, 0);
    const auto part = static_cast<std::size_t>(omp_get_thread_num());
    std::vector<NeighbourBlock> found;
    found.reserve(block.size() / (part_begin.size() - 1) * 9 / 8);  // about as many as the last time
    Index first_particle = 0;
    Index last_particle = 0;  // one past it
                              // Each thread has cells, and so particles, that follow each other.
#pragma omp for schedule(static) nowait
    for (int cell = 0; cell < cells; ++cell) {
      int at[Dim];
      grid.cell_coordinates(cell, at);
      const int index = grid.cell_index(at);
      // Where ranks share a box, ghosts lie in cells too.
      if (grid.cell_begin[index] == grid.cell_end[index] || grid.cell_begin[index] >= grid.particle_count) continue;
      Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
      const int segments = grid.segments(at, segment);
      // Two runs share a block only if they have the same shift along x.
      std::stable_sort(segment, segment + segments,
                       [](const auto& a, const auto& b) { return a.shift[0] < b.shift[0]; });
      if (first_particle == last_particle) first_particle = grid.cell_begin[index];
      last_particle = grid.cell_end[index];
      for (Index i = grid.cell_begin[index]; i < last_particle; ++i) {
        begin[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(found.size());
        Real point[Dim];
        for (int d = 0; d < Dim; ++d) point[d] = grid.local[d][i];
        if constexpr (by_two<Real>) {
          search.find_by_two(point, segment, segments, found);
        } else {
          search.find(point, segment, segments, found);
        }
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

// Twice: to count the blocks of each point, and to store them.
template <class Real, int Dim>
void NeighbourBlocks::find_around(const Neighbours<Real, Dim>& grid, const std::array<const double*, 3>& local,
                                  std::span<const std::array<int, 3>> cell, double range) {
  const Search<Real, Dim> search(grid, range);
  find_offsets(grid.width, Dim);
  const auto points = static_cast<Index>(cell.size());
  const auto find_blocks = [&](std::size_t n, std::vector<NeighbourBlock>& found) {
    found.clear();
    int at[Dim];
    Real point[Dim];
    for (int d = 0; d < Dim; ++d) {
      at[d] = cell[n][static_cast<std::size_t>(d)];
      point[d] = static_cast<Real>(local[static_cast<std::size_t>(d)][n]);
    }
    Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
    search.find(point, segment, grid.segments(at, segment), found);
  };
  begin.assign(cell.size() + 1, 0);
  std::vector<NeighbourBlock> found;
#pragma omp parallel for schedule(static) private(found)
  for (Index n = 0; n < points; ++n) {
    const auto own = static_cast<std::size_t>(n);
    find_blocks(own, found);
    begin[own + 1] = static_cast<std::int64_t>(found.size());
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  block.resize(static_cast<std::size_t>(begin.back()));
#pragma omp parallel for schedule(static) private(found)
  for (Index n = 0; n < points; ++n) {
    const auto own = static_cast<std::size_t>(n);
    find_blocks(own, found);
    std::copy(found.begin(), found.end(), block.begin() + begin[own]);
  }
}

void NeighbourBlocks::find_offsets(const double* width, int dimension) {
  for (int d = 0; d < dimension; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    offset[axis].clear();
    for (int shift = -NeighbourBlock::most_shift; shift <= NeighbourBlock::most_shift; ++shift)
      offset[axis].push_back(shift * width[d]);
    offset_single[axis].assign(offset[axis].begin(), offset[axis].end());
  }
}

// Measured on lattices and on disordered particles: a tenth more than the disc, and half a block for each row that it
// meets; where rows share blocks, half a block in all.
double NeighbourBlocks::expected_around(double range, double row, int width) {
  const double rows = 2.0 * range / row + 1.0;
  return (1.1 * std::numbers::pi * range * range + rows * (width - 1.0) / 2.0) / width;
}

double NeighbourBlocks::expected(double range, double row, int width) {
  const bool shared = width == NeighbourBlock::width<float> ? by_two<float> : by_two<double>;
  if (!shared) return expected_around(range, row, width);
  return (1.1 * std::numbers::pi * range * range + (width - 1.0) / 2.0) / width;
}

template void NeighbourBlocks::find(const Neighbours<float, 2>&, double);
template void NeighbourBlocks::find(const Neighbours<double, 2>&, double);
template void NeighbourBlocks::find(const Neighbours<float, 3>&, double);
template void NeighbourBlocks::find(const Neighbours<double, 3>&, double);

using Local = std::array<const double*, 3>;
using Cells = std::span<const std::array<int, 3>>;
template void NeighbourBlocks::find_around(const Neighbours<float, 2>&, const Local&, Cells, double);
template void NeighbourBlocks::find_around(const Neighbours<double, 2>&, const Local&, Cells, double);
template void NeighbourBlocks::find_around(const Neighbours<float, 3>&, const Local&, Cells, double);
template void NeighbourBlocks::find_around(const Neighbours<double, 3>&, const Local&, Cells, double);

}  // namespace mesogen
