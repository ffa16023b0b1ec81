#pragma once

#include <array>
#include <cstdint>

#include "exec/backend.hpp"
#include "ghosts/views.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen {

class CellGrid;
struct ImageSearch;

namespace exec {

/// Ghosts while they are made.
struct GhostArrays {
  Index* source;
  std::uint8_t* image;
  Index* cell;  ///< padded index
  std::array<double*, 3> offset;
};

/// How ghosts are made, and how they get their values.
class GhostLoops {
 public:
  GhostLoops() = default;
  GhostLoops(const GhostLoops&) = delete;
  GhostLoops& operator=(const GhostLoops&) = delete;
  virtual ~GhostLoops() = default;

  /// How many ghosts each particle has.
  virtual void count(const ImageSearch& search, Index particles, Index* number) const = 0;
  /// Ghosts in the order of their sources: particle i writes from begin[i] on. `number` counts them.
  virtual void list(const ImageSearch& search, const CellGrid& grid, Index particles, const Index* begin,
                    const GhostArrays& to, std::int64_t* number) const = 0;
  /// Place n takes what stood at order[n]; `origin` gets the tiles of the cells.
  virtual void order(const CellGrid& grid, const GhostArrays& from, const Index* order, Index count,
                     const GhostArrays& to, const std::array<double*, 3>& origin) const = 0;
  /// First and last ghost (one past it) of each cell, inside or outside the box: `cell` has padded indices, `first` is
  /// the place of the first ghost.
  virtual void find_ranges(const CellGrid& grid, const Index* cell, Index count, Index first, Index* begin,
                           Index* end) const = 0;
  /// Values of ghosts: those of their sources, by the rules of their images.
  virtual void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<float> field,
                       int components) const = 0;
  virtual void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<double> field,
                       int components) const = 0;
};

}  // namespace exec

}  // namespace mesogen
