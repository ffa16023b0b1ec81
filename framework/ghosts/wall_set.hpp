#pragma once

#include <array>
#include <functional>
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
  /// Is a wall particle in that cell near enough to the particles of this process?
  using Seen = std::function<bool(const CellGrid::Cell&)>;

  /// `reach`: how far particles of the fluid look, m.
  WallSet(const Scene& scene, const Boundary& boundary, const CellGrid& grid, const Images& images, double reach,
          exec::DeviceMemory* memory, const Seen& seen = {});

  static constexpr int no_image = -1;
  struct Member {
    WallParticle particle;  ///< as the boundary gave it, also where this is an image of it
    int image = no_image;   ///< number among Images
  };

  [[nodiscard]] Index count() const { return static_cast<Index>(members_.size()); }
  /// Are there walls at all, here or where another rank is?
  [[nodiscard]] bool anywhere() const { return anywhere_; }
  /// In the order of storage.
  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  /// The first is at that place in storage from now on.
  void move_to(Index first);
  [[nodiscard]] WallView view(exec::Side side) const;
  /// By padded cell, as places in storage; null where there are no walls. See Neighbours.
  [[nodiscard]] const Index* cell_begin(exec::Side side) const { return count() == 0 ? nullptr : cell_begin_.on(side); }
  [[nodiscard]] const Index* cell_end(exec::Side side) const { return count() == 0 ? nullptr : cell_end_.on(side); }

 private:
  void store(const CellGrid& grid, const std::vector<std::array<double, 3>>& position,
             const std::vector<CellGrid::Cell>& cell);

  bool anywhere_ = false;
  std::vector<Member> members_;
  std::vector<Index> begin_;  // by padded cell, and one more: how many walls are in cells before
  Index first_ = -1;
  exec::AxisArrays<double> position_;
  exec::AxisArrays<double> origin_;  // of the tiles of their cells
  exec::Array<Index> cell_begin_;
  exec::Array<Index> cell_end_;
};

}  // namespace mesogen
