#include "ghosts/ghosts.hpp"

namespace mesogen {

Ghosts::Arrays::Arrays(exec::Memory& memory)
    : source(memory), image(memory), cell(memory), offset(exec::three<double>(memory)) {}

void Ghosts::Arrays::resize(std::size_t count, int dimension) {
  source.resize(count);
  image.resize(count);
  cell.resize(count);
  for (int d = 0; d < dimension; ++d) offset[d].resize(count);
}

exec::GhostArrays Ghosts::Arrays::pointers() {
  return {source.data(), image.data(), cell.data(), {offset[0].data(), offset[1].data(), offset[2].data()}};
}

Ghosts::Ghosts(const Images& images, const Backend& backend)
    : images_(images),
      backend_(backend),
      listed_(backend.memory()),
      ordered_(backend.memory()),
      origin_(exec::three<double>(backend.memory())),
      begin_(backend.memory()),
      number_(backend.memory()),
      order_(backend.memory()) {}

void Ghosts::build(const Scene& scene, const CellGrid& grid, const std::array<exec::Array<double>, 3>& position,
                   double reach) {
  if (images_.count == 0) return;
  const double* const at[3] = {position[0].data(), position[1].data(), position[2].data()};
  const ImageSearch search = image_search(scene, images_, at, reach);
  const exec::CellLoops& loops = backend_.cells();
  const auto particles = static_cast<Index>(position[0].size());
  backend_.finish();
  begin_.resize(position[0].size() + 1);
  loops.count_ghosts(search, particles, begin_.data());
  const Index count = loops.running_sums(begin_.data(), particles);
  backend_.finish();
  const auto room = static_cast<std::size_t>(count);
  listed_.resize(room, scene.dimension);
  ordered_.resize(room, scene.dimension);
  for (int d = 0; d < scene.dimension; ++d) origin_[d].resize(room);
  number_.resize(room);
  order_.resize(room);
  loops.list_ghosts(search, grid, particles, begin_.data(), listed_.pointers(), number_.data());
  loops.order(listed_.cell.data(), number_.data(), count, grid.padded_count(), order_.data());
  loops.order_ghosts(grid, listed_.pointers(), order_.data(), count, ordered_.pointers(),
                     {origin_[0].data(), origin_[1].data(), origin_[2].data()});
}

GhostView Ghosts::view(Index first) const {
  GhostView view{first, count(), ordered_.source.data(), ordered_.image.data(), {}, {}};
  for (int d = 0; d < 3; ++d) {
    view.offset[d] = ordered_.offset[d].data();
    view.origin[d] = origin_[d].data();
  }
  return view;
}

}  // namespace mesogen
