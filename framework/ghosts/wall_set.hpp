#pragma once

#include <array>
#include <vector>

#include "ghosts/views.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "neighbours/cell_grid.hpp"

namespace mesogen {

/// The particles of all walls and their images beyond periodic faces, by cell: made once, for they never move.
class MESOGEN_EXPORT WallSet {
 public:
  /// `reach`: how far particles of the fluid look, m.
  WallSet(const Scene& scene, const Boundary& boundary, const CellGrid& grid, const Images& images, double reach,
          exec::DeviceMemory* memory);

  static constexpr int no_image = -1;
  struct Member {
    WallParticle particle;  ///< as the boundary gave it, also where this is an image of it
    int image = no_image;   ///< number among Images
  };

  [[nodiscard]] Index count() const { return static_cast<Index>(members_.size()); }
  /// In the order of storage.
  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  /// `first`: the place of the first in storage.
  [[nodiscard]] WallView view(Index first, exec::Side side) const;
  /// By padded cell, as places in storage; null where there are no walls. See Neighbours.
  [[nodiscard]] const Index* cell_begin(exec::Side side) const { return count() == 0 ? nullptr : cell_begin_.on(side); }
  [[nodiscard]] const Index* cell_end(exec::Side side) const { return count() == 0 ? nullptr : cell_end_.on(side); }

 private:
  void store(const CellGrid& grid, const std::vector<std::array<double, 3>>& position,
             const std::vector<CellGrid::Cell>& cell, Index first);

  std::vector<Member> members_;
  exec::AxisArrays<double> position_;
  exec::AxisArrays<double> origin_;  // of the tiles of their cells
  exec::Array<Index> cell_begin_;
  exec::Array<Index> cell_end_;
};

}  // namespace mesogen
