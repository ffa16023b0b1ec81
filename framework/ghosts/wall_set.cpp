#include "ghosts/wall_set.hpp"

#include <algorithm>
#include <numeric>

#include "ghosts/images.hpp"

namespace mesogen {

WallSet::WallSet(const Scene& scene, const Boundary& boundary, const CellGrid& grid, const Images& images, double reach,
                 exec::DeviceMemory* memory, const Seen& seen)
    : position_(exec::axis_arrays<double>(memory)),
      origin_(exec::axis_arrays<double>(memory)),
      cell_begin_(memory),
      cell_end_(memory) {
  const std::vector<WallParticle> given = boundary.wall_particles(scene, reach);
  std::vector<std::array<double, 3>> position;
  std::vector<CellGrid::Cell> cell;
  const auto add = [&](const WallParticle& particle, int image, const std::array<double, 3>& offset) {
    std::array<double, 3> at{};
    CellGrid::Cell in{};
    for (int d = 0; d < scene.dimension; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      at[axis] = particle.position[axis] + offset[axis];
      int boxes = image == no_image ? 0 : images.boxes[image][d];
      // A face at which the box ends belongs to the wall.
      if (!boundary.periodic(d)) boxes = at[axis] <= 0.0 ? -1 : at[axis] >= scene.box[axis] ? 1 : 0;
      in[axis] = grid.beside(d, at[axis], boxes);
    }
    if (seen && !seen(in)) return;
    members_.push_back({particle, image});
    position.push_back(at);
    cell.push_back(in);
  };
  anywhere_ = !given.empty();
  std::array<std::vector<double>, 3> coordinates;
  for (const WallParticle& particle : given)
    for (std::size_t d = 0; d < 3; ++d) coordinates[d].push_back(particle.position[d]);
  const double* const points[3] = {coordinates[0].data(), coordinates[1].data(), coordinates[2].data()};
  const ImageSearch search = image_search(scene, images, points, static_cast<Index>(given.size()), reach);
  for (std::size_t n = 0; n < given.size(); ++n) {
    add(given[n], no_image, {});
    for (int image = 0; image < images.count; ++image) {
      double offset[3] = {};
      if (search.sees(image, static_cast<Index>(n), offset)) add(given[n], image, {offset[0], offset[1], offset[2]});
    }
  }
  if (!members_.empty()) store(grid, position, cell);
}

// By cell, and as they came within a cell.
void WallSet::store(const CellGrid& grid, const std::vector<std::array<double, 3>>& position,
                    const std::vector<CellGrid::Cell>& cell) {
  std::vector<std::size_t> order(members_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t n) { return grid.padded_index(cell[n]); });
  const std::vector<Member> unordered = members_;
  begin_.assign(static_cast<std::size_t>(grid.padded_count()) + 1, 0);
  std::array<std::vector<double>, 3> stored;
  std::array<std::vector<double>, 3> origin;
  for (std::size_t n = 0; n < order.size(); ++n) {
    members_[n] = unordered[order[n]];
    const CellGrid::Cell& in = cell[order[n]];
    ++begin_[static_cast<std::size_t>(grid.padded_index(in)) + 1];
    for (int d = 0; d < grid.dimension(); ++d) {
      const auto axis = static_cast<std::size_t>(d);
      stored[axis].push_back(position[order[n]][axis]);
      origin[axis].push_back(grid.tile_origin(d, in[axis]));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position_[axis].assign(stored[axis]);
    origin_[axis].assign(origin[axis]);
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
}

void WallSet::move_to(Index first) {
  if (first == first_) return;
  first_ = first;
  if (members_.empty()) return;
  std::vector<Index> place = begin_;
  for (Index& number : place) number += first;
  cell_begin_.assign(std::span(place).first(place.size() - 1));
  cell_end_.assign(std::span(place).subspan(1));
}

WallView WallSet::view(exec::Side side) const {
  WallView view{first_, count(), {}, {}};
  for (int d = 0; d < 3; ++d) {
    view.position[d] = position_[d].on(side);
    view.origin[d] = origin_[d].on(side);
  }
  return view;
}

}  // namespace mesogen
