#pragma once

#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// A run of particles that are contiguous in storage. It also says how their coordinates relate to those of the cell
/// that looks at them: r_i - r_j = (local_i - offset) - local_j, with offset = shift * width of a cell.
template <class Real, int Dim>
struct Segment {
  Index begin;
  Index end;
  int shift[Dim];
  Real offset[Dim];
};

/// A few neighbours of one particle: what a pair sum handles at a time. They are one or two runs that are contiguous in
/// storage; two runs have the same shift along x.
struct NeighbourBlock {
  /// Largest number of neighbours in a block: the number of lanes of the widest pack.
  template <class Real>
  static constexpr int width = 64 / sizeof(Real);
  static constexpr int most_dimensions = 3;
  static constexpr int most_shift = 127;

  Index first;                                ///< lane n holds particle first + n, and from lane `split` on
  Index second;                               ///< particle second + n; the same as `first` if there is one run
  std::int8_t lanes;                          ///< number of neighbours in the block
  std::int8_t split;                          ///< number of neighbours in the first run
  std::int8_t shift[most_dimensions];         ///< of the first run, in cells, as in Segment
  std::int8_t second_shift[most_dimensions];  ///< of the second run, or of the first if there is one run

  [[nodiscard]] Index particle(int lane) const { return (lane < split ? first : second) + lane; }
  [[nodiscard]] int shift_at(int lane, int axis) const { return (lane < split ? shift : second_shift)[axis]; }
};

/// Some neighbours of one particle that are contiguous in storage, with the same shift: what a pair sum on a device
/// goes by. Aligned, so that a device reads it at once.
struct alignas(8) NeighbourRun {
  static constexpr Index longest = 255;

  Index first;
  std::uint8_t count;
  std::int8_t shift[NeighbourBlock::most_dimensions];  ///< in cells, as in Segment
};

/// The neighbours of each particle: the cell grid as a pair pass sees it. Trivially copyable.
///
/// Particles are stored by cell. A cell is a quarter of the search range long (along x) and half of it high, so that
/// the neighbours of a particle are five short contiguous runs in storage in 2D (25 in 3D). The parts of these runs
/// that are within reach are found once per sorting and kept: on the host put together to blocks, on a device as runs.
/// Coordinates are relative to a tile (a group of cells of one row). They are small numbers, so float is accurate
/// enough for any box size and any distance from the origin. The same offsets carry periodic images: a wrapped box
/// needs no minimum image in the loop. Ghosts need no special treatment either: they are in cells outside the box. Wall
/// particles are separate runs in the same cells.
template <class Real, int Dim>
struct Neighbours {
  const Real* local[Dim];   ///< particle coordinates relative to the tile of their cell, m
  const Index* cell_begin;  ///< by cell: particles in cells inside the box, ghosts in cells outside
  const Index* cell_end;
  const Index* wall_begin;  ///< by cell, inside or outside: wall particles; null if there are none
  const Index* wall_end;
  const Index* cell_of;             ///< for each particle, the number of its cell inside the box
  const std::int64_t* block_begin;  ///< for each particle, index of its first block; one more at the end
  const NeighbourBlock* block;      ///< of a particle: they hold each particle within the support once, and itself
  const Real* offset[Dim];          ///< by shift of a block, from -most_shift to most_shift, m
  const Index* run_begin;           ///< the same as runs, on a device: for each particle, index of its first one
  const NeighbourRun* run;
  Index particle_count;  ///< particles of the fluid
  int cells[Dim];        ///< cells inside the box
  int padding[Dim];      ///< layers of cells on either side of the box, for ghosts and walls
  int reach[Dim];        ///< largest distance of a neighbour, in cells
  bool wrapped[Dim];     ///< true if the grid continues on the other side
  double width[Dim];     ///< of a cell, m
  int tile;              ///< cells in a tile, along x
  Real radius;           ///< support of the kernel, m
  Real smallest;         ///< added to the square of a distance, so that 1/r is finite for a particle and itself, m^2

  static constexpr int most_segments_by_dimension[4] = {0, 1, 48, 240};
  static constexpr int most_segments = most_segments_by_dimension[Dim];

  [[nodiscard]] MESOGEN_HOST_DEVICE int cell_count() const {
    int n = 1;
    for (int d = 0; d < Dim; ++d) n *= cells[d];
    return n;
  }

  /// Index into cell_begin of the cell with these coordinates. The cell may be in the padding.
  [[nodiscard]] MESOGEN_HOST_DEVICE int cell_index(const int (&at)[Dim]) const {
    int index = 0;
    for (int d = Dim - 1; d >= 0; --d) index = index * (cells[d] + 2 * padding[d]) + at[d] + padding[d];
    return index;
  }

  /// Coordinates of the n-th cell inside the box.
  MESOGEN_HOST_DEVICE void cell_coordinates(int n, int (&at)[Dim]) const {
    for (int d = 0; d < Dim; ++d) {
      at[d] = n % cells[d];
      n /= cells[d];
    }
  }

  /// Calls action(segment) for all runs of particles within reach of a cell, at most most_segments.
  template <class Action>
  MESOGEN_HOST_DEVICE void for_each_segment(const int (&centre)[Dim], const Action& action) const {
    int row[Dim];
    visit_rows<Dim - 1>(centre, row, tile_of(centre[0]).first, action);
  }

  /// Writes these segments to `out`, and returns their number.
  int segments(const int (&centre)[Dim], Segment<Real, Dim>* out) const {
    int count = 0;
    for_each_segment(centre, [&](const Segment<Real, Dim>& segment) { out[count++] = segment; });
    return count;
  }

  /// The group of cells [first, last] along x that contains cell `at`. The coordinates of its particles are relative to
  /// the beginning of cell `first`. `first_stored` is the cell where `first` is stored: another cell if the grid wraps.
  struct Tile {
    int first;
    int last;
    int first_stored;
  };
  [[nodiscard]] MESOGEN_HOST_DEVICE Tile tile_of(int at) const {
    const int n = cells[0];
    if (!wrapped[0] && at < 0) return {-padding[0], -1, -padding[0]};
    if (!wrapped[0] && at >= n) return {n, n + padding[0] - 1, n};
    int image = 0;
    if (at < 0 || at >= n) {
      image = at / n;
      if (at < image * n) --image;
    }
    const int stored = (at - image * n) / tile * tile;
    const int first = image * n + stored;
    const int last = first + tile < (image + 1) * n ? first + tile - 1 : (image + 1) * n - 1;
    return {first, last, stored};
  }

 private:
  /// All rows within reach along this axis and those before it.
  template <int Axis, class Action>
  MESOGEN_HOST_DEVICE void visit_rows(const int (&centre)[Dim], int (&row)[Dim], int origin,
                                      const Action& action) const {
    if constexpr (Axis == 0) {
      visit_row(centre, row, origin, action);
    } else {
      for (row[Axis] = -reach[Axis]; row[Axis] <= reach[Axis]; ++row[Axis])
        visit_rows<Axis - 1>(centre, row, origin, action);
    }
  }

  template <class Action>
  MESOGEN_HOST_DEVICE void visit_row(const int (&centre)[Dim], const int (&row)[Dim], int origin,
                                     const Action& action) const {
    int at[Dim];
    Segment<Real, Dim> segment{};
    for (int d = 1; d < Dim; ++d) {
      segment.shift[d] = row[d];
      segment.offset[d] = Real(row[d] * width[d]);
      at[d] = centre[d] + row[d];
      if (wrapped[d] && (at[d] < 0 || at[d] >= cells[d])) at[d] = ((at[d] % cells[d]) + cells[d]) % cells[d];
    }
    const int to = centre[0] + reach[0];
    for (int from = centre[0] - reach[0]; from <= to;) {
      const Tile t = tile_of(from);
      const int last = t.last < to ? t.last : to;
      at[0] = t.first_stored + (from - t.first);
      const int first_cell = cell_index(at);
      const int last_cell = first_cell + last - from;
      segment.shift[0] = t.first - origin;
      segment.offset[0] = Real(segment.shift[0] * width[0]);
      segment.begin = cell_begin[first_cell];
      segment.end = cell_end[last_cell];
      if (segment.begin < segment.end) action(segment);
      if (wall_begin != nullptr) {
        segment.begin = wall_begin[first_cell];
        segment.end = wall_end[last_cell];
        if (segment.begin < segment.end) action(segment);
      }
      from = last + 1;
    }
  }
};

}  // namespace mesogen
