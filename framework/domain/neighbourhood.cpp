#include "domain/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "exec/outside.hpp"
#include "mesogen/exec/first_failure.hpp"

namespace mesogen {

namespace {

template <class T>
std::array<exec::Array<T>, 3> three(exec::Memory& memory) {
  return {exec::Array<T>(memory), exec::Array<T>(memory), exec::Array<T>(memory)};
}

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
      sorted_position_(three<double>(backend.memory())),
      order_(backend.memory()),
      cell_of_(backend.memory()),
      cell_begin_(backend.memory()),
      cell_end_(backend.memory()),
      blocks_wanted_(backend.on_host()),
      copy_source_(backend.memory()),
      copy_offset_(three<double>(backend.memory())),
      outside_origin_(three<double>(backend.memory())),
      local_single_(three<float>(backend.memory())),
      local_double_(three<double>(backend.memory())),
      scratch_(backend.memory()) {
  boundary.dummies(scene, scene.support + skin_, dummies_);
}

std::array<double, 3> Neighbourhood::sorted_at(Index i) const {
  std::array<double, 3> at{};
  for (int d = 0; d < scene_.dimension; ++d) at[d] = sorted_position_[d][i];
  return at;
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
  make_outside();
  blocks_found_ = false;
}

void Neighbourhood::restore(const std::array<std::vector<double>, 3>& sorted_position) {
  ++version_;
  for (int d = 0; d < scene_.dimension; ++d)
    sorted_position_[d].assign(sorted_position[d].begin(), sorted_position[d].end());
  find_cells();
  make_outside();
  blocks_found_ = false;
}

// Wherever particles are by now, their blocks are those of the last sorting. Leaves the particles placed there.
void Neighbourhood::find_blocks() {
  blocks_found_ = true;
  (void)place(sorted_position_);
  if (!blocks_wanted_) return;
  backend_.finish();
  const bool single = scene_.precision == Precision::single_precision;
  if (scene_.dimension == 2) {
    single ? find_blocks_of<float, 2>() : find_blocks_of<double, 2>();
  } else {
    single ? find_blocks_of<float, 3>() : find_blocks_of<double, 3>();
  }
}

template <class Real, int Dim>
void Neighbourhood::find_blocks_of() {
  Neighbours<Real, Dim> grid{};
  fill(grid);
  // Two particles may each move by half the skin; a hundredth of it is for rounding.
  blocks_.find(grid, scene_.support + 1.01 * skin_);
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

// Coordinates relative to tiles; false if a particle has left the skin.
template <class Real>
bool Neighbourhood::place(const std::array<exec::Array<double>, 3>& position,
                          std::array<exec::Array<Real>, 3>& local) const {
  exec::Placing<Real> placing{};
  for (int d = 0; d < scene_.dimension; ++d) {
    placing.position[d] = position[d].data();
    placing.sorted[d] = sorted_position_[d].data();
    placing.local[d] = local[d].data();
    placing.offset[d] = copy_offset_[d].data();
    placing.origin[d] = outside_origin_[d].data();
  }
  placing.cell_begin = cell_begin_.data();
  placing.cell_end = cell_end_.data();
  placing.farthest_square = skin_ * skin_ / 4.0;
  placing.particles = static_cast<Index>(position[0].size());
  placing.copies = static_cast<Index>(copy_source_.size());
  placing.source = copy_source_.data();
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
  grid.cell_of = cell_of_.data();
  grid.block_begin = blocks_.begin.data();
  grid.block = blocks_.block.data();
  grid.particle_count = static_cast<Index>(cell_of_.size());
  grid.tile = CellGrid::cells_in_tile;
  grid.radius = Real(scene_.support);
  const double h = scene_.smoothing_length;
  grid.smallest = Real((sizeof(Real) == sizeof(float) ? 1e-14 : 1e-30) * h * h);
}
template void Neighbourhood::fill(Neighbours<float, 2>&) const;
template void Neighbourhood::fill(Neighbours<double, 2>&) const;
template void Neighbourhood::fill(Neighbours<float, 3>&) const;
template void Neighbourhood::fill(Neighbours<double, 3>&) const;

}  // namespace mesogen
