#include "neighbours/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "exec/outside.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/first_failure.hpp"

namespace mesogen {

namespace {

// Pair loops read whole packs.
constexpr std::size_t pack_tail = 16;

template <class T>
std::array<const T*, 3> places(const std::array<exec::Array<T>, 3>& arrays) {
  return {arrays[0].data(), arrays[1].data(), arrays[2].data()};
}

}  // namespace

Neighbourhood::Neighbourhood(const Scene& scene, const Boundary& boundary, const Backend& backend)
    : scene_(scene),
      boundary_(boundary),
      backend_(backend),
      skin_(skin_in_spacings * scene.spacing),
      grid_(scene, boundary, scene.support + skin_),
      sorted_position_(exec::three<double>(backend.memory())),
      order_(backend.memory()),
      cell_of_(backend.memory()),
      cell_begin_(static_cast<std::size_t>(grid_.padded_count()), 0, backend.memory()),
      cell_end_(cell_begin_.size(), 0, backend.memory()),
      blocks_wanted_(backend.on_host()),
      ghosts_(images_of(scene, boundary), backend),
      walls_(scene, boundary, grid_, ghosts_.images(), scene.support + skin_, backend.memory()),
      local_single_(exec::three<float>(backend.memory())),
      local_double_(exec::three<double>(backend.memory())),
      scratch_(backend.memory()) {
  place_mirrors();
}

void Neighbourhood::place_mirrors() {
  for (const WallSet::Member& wall : walls_.members()) {
    mirror_cell_.push_back(grid_.nearest_inside(wall.particle.mirror));
    for (int d = 0; d < scene_.dimension; ++d)
      mirror_local_[d].push_back(wall.particle.mirror[d] - grid_.tile_origin(d, mirror_cell_.back()[d]));
  }
}

const exec::Array<Index>* Neighbourhood::update(Particles& particles) {
  if (update_without_sorting(particles)) return nullptr;
  order(particles);
  find_blocks();
  return &order_;
}

bool Neighbourhood::update_without_sorting(const Particles& particles) {
  ++version_;
  if (cell_of_.empty() || !place(particles.position)) return false;
  if (!blocks_found_) {
    find_blocks();
    (void)place(particles.position);
  }
  return true;
}

const exec::Array<Index>& Neighbourhood::reorder(Particles& particles) {
  ++version_;
  order(particles);
  return order_;
}

void Neighbourhood::order(Particles& particles) {
  sort_particles(particles);
  find_cells();
  build_ghosts();
  blocks_found_ = false;
}

void Neighbourhood::restore(const std::array<std::vector<double>, 3>& sorted_position) {
  ++version_;
  for (int d = 0; d < scene_.dimension; ++d)
    sorted_position_[d].assign(sorted_position[d].begin(), sorted_position[d].end());
  find_cells();
  build_ghosts();
  blocks_found_ = false;
}

// Wherever particles are by now, their blocks are those of the last sorting. Leaves the particles placed there.
void Neighbourhood::find_blocks() {
  blocks_found_ = true;
  (void)place(sorted_position_);
  if (!blocks_wanted_ && walls_.count() == 0) return;
  backend_.finish();
  dispatch(scene_.precision, scene_.dimension, [&]<class Real, int Dim>() { find_blocks_of<Real, Dim>(); });
}

template <class Real, int Dim>
void Neighbourhood::find_blocks_of() {
  Neighbours<Real, Dim> grid{};
  fill(grid);
  // Two particles may each move by half the skin; a hundredth of it is for rounding.
  if (blocks_wanted_) blocks_.find(grid, scene_.support + 1.01 * skin_);
  // A mirror point sees the fluid alone, and does not move.
  grid.wall_begin = grid.wall_end = nullptr;
  if (walls_.count() > 0) mirror_blocks_.find_around(grid, mirror_local_, mirror_cell_, scene_.support + 0.51 * skin_);
}

void Neighbourhood::keep_inside(Particles& particles, Index i) const {
  std::array<double, 3> at{};
  std::array<std::int32_t, 3> images{};
  for (int d = 0; d < scene_.dimension; ++d) {
    at[d] = particles.position[d][i];
    images[d] = particles.images[d][i];
  }
  boundary_.keep_inside(scene_, at.data(), images.data());
  for (int d = 0; d < scene_.dimension; ++d) {
    particles.position[d][i] = at[d];
    particles.images[d][i] = images[d];
  }
}

void Neighbourhood::keep_inside(Particles& particles) {
  const Index count = particles.count();
  const auto at = places(particles.position);
  Index* left = nullptr;
  Index number = count;
  // On a device it finds who left the box, so that no others come to the host.
  if (!backend_.on_host()) {
    order_.resize(particles.id.size());
    left = order_.data();
    number = backend_.cells().find_outside(at.data(), scene_.box.data(), scene_.dimension, count, left);
    backend_.finish();
  }
  exec::FirstFailure failure;
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < number; ++n) {
    const Index i = left == nullptr ? n : left[n];
    if (exec::is_inside(at.data(), scene_.box.data(), scene_.dimension, i)) continue;
    try {
      keep_inside(particles, i);
    } catch (...) {
      failure.keep();
    }
  }
  failure.rethrow();
}

// Storage goes by cell, and by id within a cell: the order of sums depends on positions alone.
void Neighbourhood::sort_particles(Particles& particles) {
  const Index count = particles.count();
  keep_inside(particles);
  const exec::CellLoops& loops = backend_.cells();
  for (int d = 0; d < scene_.dimension; ++d) {
    sorted_position_[d].resize(particles.id.size());
    loops.copy(particles.position[d].data(), sorted_position_[d].data(), count);
  }
  find_cells();
  order_.resize(particles.id.size());
  loops.order(cell_of_.data(), particles.id.data(), count, grid_.inside_count(), order_.data());
  const auto permute = [&](auto& values, auto& scratch) {
    scratch.resize(values.size());
    loops.permute(values.data(), order_.data(), count, scratch.data());
  };
  permute(particles.id, scratch_.id);
  for (int d = 0; d < scene_.dimension; ++d) {
    permute(particles.position[d], scratch_.position);
    permute(particles.images[d], scratch_.images);
    permute(sorted_position_[d], scratch_.position);
  }
  ++sortings_;
}

void Neighbourhood::find_cells() {
  const auto count = static_cast<Index>(sorted_position_[0].size());
  cell_of_.resize(static_cast<std::size_t>(count));
  backend_.cells().find_cells(grid_, places(sorted_position_).data(), count, cell_of_.data());
}

// Ghosts are found by cell as particles are; those of the walls have tables of their own.
void Neighbourhood::build_ghosts() {
  const auto count = static_cast<Index>(cell_of_.size());
  ghosts_.build(scene_, grid_, sorted_position_, scene_.support + skin_);
  if (ghosts_.images().count > 0)
    backend_.cells().find_ghost_ranges(grid_, ghosts_.cell().data(), ghosts_.count(), count + walls_.count(),
                                       cell_begin_.data(), cell_end_.data());
  backend_.cells().find_ranges(grid_, cell_of_.data(), count, cell_begin_.data(), cell_end_.data());
  make_room();
  ++sorted_version_;
}

void Neighbourhood::make_room() {
  backend_.finish();
  const std::size_t stored = cell_of_.size() + static_cast<std::size_t>(boundary_count()) + pack_tail;
  const auto resize = [&](auto& local) {
    // Ghosts come and go: a little room keeps the array where it is.
    if (local.capacity() < stored) local.reserve(stored + stored / 16);
    local.resize(stored);
    std::fill(local.end() - pack_tail, local.end(), 0);
  };
  for (int d = 0; d < scene_.dimension; ++d)
    scene_.precision == Precision::single_precision ? resize(local_single_[d]) : resize(local_double_[d]);
}

// Coordinates relative to tiles; false if a particle has left the skin.
template <class Real>
bool Neighbourhood::place(const std::array<exec::Array<double>, 3>& position,
                          std::array<exec::Array<Real>, 3>& local) const {
  exec::Placing<Real> placing{};
  for (int d = 0; d < scene_.dimension; ++d) {
    placing.position[d] = position[d].data();
    placing.sorted[d] = sorted_position_[d].data();
    placing.local[d] = local[d].data();
  }
  placing.cell_begin = cell_begin_.data();
  placing.cell_end = cell_end_.data();
  placing.farthest_square = skin_ * skin_ / 4.0;
  placing.walls = wall_view();
  placing.ghosts = ghost_view();
  return backend_.loops<Real>().place(grid_, placing);
}

bool Neighbourhood::place(const std::array<exec::Array<double>, 3>& position) {
  return scene_.precision == Precision::single_precision ? place(position, local_single_)
                                                         : place(position, local_double_);
}

template <class Real, int Dim>
void Neighbourhood::fill(Neighbours<Real, Dim>& grid) const {
  for (int d = 0; d < Dim; ++d) {
    if constexpr (sizeof(Real) == sizeof(float)) {
      grid.local[d] = local_single_[d].data();
      grid.offset[d] = blocks_.offset_single[d].data();
    } else {
      grid.local[d] = local_double_[d].data();
      grid.offset[d] = blocks_.offset[d].data();
    }
    grid.cells[d] = grid_.cells(d);
    grid.padding[d] = grid_.padding(d);
    grid.reach[d] = grid_.reach(d);
    grid.wrapped[d] = grid_.wrapped(d);
    grid.width[d] = grid_.width(d);
  }
  grid.cell_begin = cell_begin_.data();
  grid.cell_end = cell_end_.data();
  grid.wall_begin = walls_.cell_begin();
  grid.wall_end = walls_.cell_end();
  grid.cell_of = cell_of_.data();
  grid.block_begin = blocks_.begin.data();
  grid.block = blocks_.block.data();
  grid.particle_count = static_cast<Index>(cell_of_.size());
  grid.tile = CellGrid::cells_in_tile;
  grid.radius = Real(scene_.support);
  const double h = scene_.smoothing_length;
  grid.smallest = Real((sizeof(Real) == sizeof(float) ? 1e-14 : 1e-30) * h * h);
}
template <int Dim>
sph::MirrorPoints<Dim> Neighbourhood::mirrors() const {
  sph::MirrorPoints<Dim> points{walls_.count(), {}, {}, mirror_blocks_.begin.data(), mirror_blocks_.block.data()};
  for (int d = 0; d < Dim; ++d) {
    points.local[d] = mirror_local_[d].data();
    points.offset[d] = mirror_blocks_.offset[d].data();
  }
  return points;
}
template sph::MirrorPoints<2> Neighbourhood::mirrors() const;
template sph::MirrorPoints<3> Neighbourhood::mirrors() const;

template void Neighbourhood::fill(Neighbours<float, 2>&) const;
template void Neighbourhood::fill(Neighbours<double, 2>&) const;
template void Neighbourhood::fill(Neighbours<float, 3>&) const;
template void Neighbourhood::fill(Neighbours<double, 3>&) const;

}  // namespace mesogen
