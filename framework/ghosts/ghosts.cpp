#include "ghosts/ghosts.hpp"

#include "neighbours/cell_loops.hpp"

namespace mesogen {

Ghosts::Arrays::Arrays(exec::DeviceMemory* memory)
    : source(memory), image(memory), cell(memory), offset(exec::axis_arrays<double>(memory)) {}

void Ghosts::Arrays::resize(std::size_t count, int dimension) {
  source.resize_for_overwrite(count);
  image.resize_for_overwrite(count);
  cell.resize_for_overwrite(count);
  for (int d = 0; d < dimension; ++d) offset[d].resize_for_overwrite(count);
}

exec::GhostArrays Ghosts::Arrays::pointers(exec::Access access) {
  return {source.device(access),
          image.device(access),
          cell.device(access),
          {offset[0].device(access), offset[1].device(access), offset[2].device(access)}};
}

Ghosts::Ghosts(const Images& images, bool several, const Backend& backend)
    : images_(images),
      possible_(images.count > 0 || several),
      backend_(backend),
      listed_(backend.memory()),
      ordered_(backend.memory()),
      origin_(exec::axis_arrays<double>(backend.memory())),
      begin_(backend.memory()),
      number_(backend.memory()),
      order_(backend.memory()) {}

void Ghosts::build(const CellGrid& grid, const ImageSearch& search, Index own, Index others) {
  own_ = own;
  if (!possible_) return;
  using exec::Access;
  const exec::GhostLoops& loops = backend_.ghosts();
  const Index particles = own + others;
  begin_.resize_for_overwrite(static_cast<std::size_t>(particles) + 1);
  loops.count(search, particles, begin_.device(Access::write));
  const Index count = backend_.cells().running_sums(begin_.device(Access::read_write), particles);
  const auto room = static_cast<std::size_t>(count);
  listed_.resize(room, grid.dimension());
  ordered_.resize(room, grid.dimension());
  for (int d = 0; d < grid.dimension(); ++d) origin_[d].resize_for_overwrite(room);
  number_.resize_for_overwrite(room);
  order_.resize_for_overwrite(room);
  loops.list(search, grid, particles, begin_.device(), listed_.pointers(Access::write), number_.device(Access::write));
  backend_.cells().order(listed_.cell.device(), number_.device(), count, grid.padded_count(),
                         order_.device(Access::write));
  std::array<double*, 3> origin{};
  for (std::size_t d = 0; d < 3; ++d) origin[d] = origin_[d].device(Access::write);
  loops.order(grid, listed_.pointers(Access::read_write), order_.device(), count, ordered_.pointers(Access::write),
              origin);
}

GhostView Ghosts::view(Index first, exec::Side side) const {
  GhostView view{first, count(), own_, ordered_.source.on(side), ordered_.image.on(side), {}, {}, {}};
  for (int d = 0; d < 3; ++d) {
    view.offset[d] = ordered_.offset[d].on(side);
    view.origin[d] = origin_[d].on(side);
  }
  return view;
}

}  // namespace mesogen
