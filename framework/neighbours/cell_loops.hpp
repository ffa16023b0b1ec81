#pragma once

#include <array>
#include <cstdint>

#include "exec/backend.hpp"
#include "mesogen/fields/field_view.hpp"
#include "neighbours/stored_views.hpp"
#include "particles/field_loops.hpp"

namespace mesogen {

class CellGrid;

/// Cells of the box by their numbers: those that may hold particles of this process.
struct CellSpan {
  Index first;
  Index end;
};

namespace exec {

/// Coordinates relative to the tiles of the cell grid, of particles, walls and ghosts.
template <class Real>
struct PlaceArguments {
  const double* position[3];
  const double* sorted[3];  ///< where particles were sorted
  Real* local[3];
  Index count;        ///< of particles
  const Index* cell;  ///< of each particle
  const Index* cell_begin;
  const Index* cell_end;
  CellSpan cells;          ///< that may hold particles
  bool looks;              ///< whether a particle has strayed
  double farthest_square;  ///< by which it may have, m2
  WallView walls;
  GhostView ghosts;
};

/// Particles in a cell grid: where they are in it, and what its order is.
class CellLoops {
 public:
  CellLoops() = default;
  CellLoops(const CellLoops&) = delete;
  CellLoops& operator=(const CellLoops&) = delete;
  virtual ~CellLoops() = default;

  /// The cell of each position; where there is no such number, some cell.
  virtual void find_cells(const CellGrid& grid, const double* const* position, Index count, Index* cell) const = 0;
  /// Place n takes what stood at order[n]: by cell, by id within a cell.
  virtual void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const = 0;
  /// First and last particle (one past it) of each of these cells, from particles stored by cell.
  virtual void find_ranges(const CellGrid& grid, CellSpan cells, const Index* cell, Index count, Index* begin,
                           Index* end) const = 0;
  /// Particles outside the box: as many as it returns, in no order, at `found`, which has room for all.
  virtual Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                             Index* found) const = 0;
  /// values[i] becomes the sum of all before it, values[count] the sum of all, which it returns. Waits for the answer.
  virtual Index running_sums(Index* values, Index count) const = 0;
  /// False if it looks, and a particle has strayed too far. Waits for the answer.
  virtual bool place(const CellGrid& grid, const PlaceArguments<float>& arguments) const = 0;
  virtual bool place(const CellGrid& grid, const PlaceArguments<double>& arguments) const = 0;
  /// Moves particles and places them where they then are, on a device in one loop. Nobody looks whether one strays.
  virtual void move_and_place(const CellGrid& grid, const MoveArguments<float>& move,
                              const PlaceArguments<float>& place) const = 0;
  virtual void move_and_place(const CellGrid& grid, const MoveArguments<double>& move,
                              const PlaceArguments<double>& place) const = 0;
  virtual void move_and_place(const CellGrid& grid, const MoveByPassesArguments<float>& move,
                              const PlaceArguments<float>& place) const = 0;
  virtual void move_and_place(const CellGrid& grid, const MoveByPassesArguments<double>& move,
                              const PlaceArguments<double>& place) const = 0;
};

}  // namespace exec

}  // namespace mesogen
