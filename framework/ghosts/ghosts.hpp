#pragma once

#include <array>
#include <cstdint>

#include "exec/backend.hpp"
#include "ghosts/ghost_loops.hpp"
#include "ghosts/images.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "neighbours/cell_grid.hpp"

namespace mesogen {

/// Ghosts of particles beyond the faces, and of those that other ranks have: source and offset of each, by cell in
/// storage.
class MESOGEN_EXPORT Ghosts {
 public:
  /// `several`: there are other ranks.
  Ghosts(const Images& images, bool several, const Backend& backend);

  /// Makes the ghosts of points: `own` particles that are sorted, and `others`.
  void build(const CellGrid& grid, const ImageSearch& search, Index own, Index others);

  [[nodiscard]] Index count() const { return static_cast<Index>(ordered_.source.size()); }
  /// Can there be any?
  [[nodiscard]] bool possible() const { return possible_; }
  [[nodiscard]] const Images& images() const { return images_; }
  /// Padded index of each one's cell, in ascending order.
  [[nodiscard]] const exec::Array<Index>& cell() const { return ordered_.cell; }
  /// `first`: the place of the first in storage. The caller adds where sources of other ranks are.
  [[nodiscard]] GhostView view(Index first, exec::Side side) const;

 private:
  struct Arrays {
    explicit Arrays(exec::DeviceMemory* memory);
    void resize(std::size_t count, int dimension);
    /// On the device, to write.
    [[nodiscard]] exec::GhostArrays pointers(exec::Access access);

    exec::Array<Index> source;
    exec::Array<std::uint8_t> image;
    exec::Array<Index> cell;
    exec::AxisArrays<double> offset;
  };

  Images images_;
  bool possible_;
  const Backend& backend_;
  Index own_ = 0;
  Arrays listed_;
  Arrays ordered_;
  exec::AxisArrays<double> origin_;   // of the tiles of those in order
  exec::Array<Index> begin_;          // by particle, one more at the end
  exec::Array<std::int64_t> number_;  // by ghost, as they are listed
  exec::Array<Index> order_;
};

}  // namespace mesogen
