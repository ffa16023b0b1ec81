#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ghosts/images.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "neighbours/cell_grid.hpp"
#include "neighbours/cell_loops.hpp"

namespace mesogen {

/// How ranks share a box: each has whole rows of cells along the last axis (in 3D: layers), about as many particles as
/// the others. All ranks know all parts.
class MESOGEN_EXPORT Parts {
 public:
  /// Equal numbers of rows. Throws Error(bad_case) if there are more ranks than rows.
  Parts(const CellGrid& grid, int ranks);

  [[nodiscard]] int axis() const { return axis_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Of a cell inside the box, by its number.
  [[nodiscard]] int row_of(Index cell) const { return cell / cells_in_row_; }
  [[nodiscard]] int owner_of(int row) const;
  [[nodiscard]] int begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  [[nodiscard]] int end(int rank) const { return begin_[static_cast<std::size_t>(rank) + 1]; }
  /// The cells of a rank.
  [[nodiscard]] CellSpan cells(int rank) const { return {begin(rank) * cells_in_row_, end(rank) * cells_in_row_}; }
  /// What a rank sees that looks `reach` rows beyond its own.
  [[nodiscard]] Slab slab(int rank, int reach) const;
  /// Does it see that row, or where the box wraps or has images, one of its images?
  [[nodiscard]] bool sees_wrapped(int rank, int reach, int row) const;
  /// Does it see that row of the padded grid?
  [[nodiscard]] bool sees(int rank, int reach, int row) const {
    return wrapped_ ? sees_wrapped(rank, reach, row) : row >= begin(rank) - reach && row < end(rank) + reach;
  }

  /// Moves the borders to where every rank has about as many particles, if one has too many now. Were they moved?
  bool balance(std::span<const std::int64_t> particles_in_row);
  /// Borders from a checkpoint, and whether they are some of these ranks in this box.
  [[nodiscard]] bool can_take(std::span<const std::int64_t> begins) const;
  void take(std::span<const std::int64_t> begins);
  [[nodiscard]] const std::vector<int>& begins() const { return begin_; }

 private:
  [[nodiscard]] std::int64_t most_in(const std::vector<int>& begins, std::span<const std::int64_t> in_row) const;

  int axis_;
  int rows_;
  Index cells_in_row_;
  double height_;  // of a row, m
  bool wrapped_;
  int ranks_;
  std::vector<int> begin_;  // by rank, one more at the end
};

}  // namespace mesogen
