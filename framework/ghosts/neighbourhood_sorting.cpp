// How particles come into the order of cells, and to the rank that has them.

#include <algorithm>

#include "ghosts/neighbourhood.hpp"
#include "mesogen/exec/first_failure.hpp"
#include "neighbours/cell_loops.hpp"
#include "neighbours/outside.hpp"
#include "particles/storage_loops.hpp"

namespace mesogen {

namespace {

constexpr auto device = exec::Side::device;
using exec::Access;

}  // namespace

std::vector<int> Neighbourhood::owners(Particles& particles, bool may_balance) {
  keep_inside(particles);
  exec::Array<Index> cells(backend_.memory());
  cells.resize_for_overwrite(particles.id.size());
  backend_.cells().find_cells(grid_, exec::pointers(particles.position, device).data(), particles.count(),
                              cells.device(Access::write));
  const auto cell = cells.host();
  if (may_balance) {
    std::vector<std::int64_t> in_row(static_cast<std::size_t>(parts_.rows()), 0);
    for (const Index number : cell) ++in_row[static_cast<std::size_t>(parts_.row_of(number))];
    ranks_.add(in_row);
    if (parts_.balance(in_row)) make_walls();
  }
  std::vector<int> owners(cell.size());
  std::ranges::transform(cell, owners.begin(), [&](Index number) { return parts_.owner_of(parts_.row_of(number)); });
  return owners;
}

void Neighbourhood::take_parts(std::span<const std::int64_t> begins) {
  parts_.take(begins);
  make_walls();
}

void Neighbourhood::keep_inside(Particles& particles) {
  const Index count = particles.count();
  Index number = count;
  const Index* left = nullptr;
  // On a device it finds who left the box: mostly nobody, and nothing comes to the host.
  if (!backend_.on_host() && !scene_.solids) {
    order_.resize_for_overwrite(particles.id.size());
    number = backend_.cells().find_outside(exec::pointers(particles.position, device).data(), scene_.box.data(),
                                           scene_.dimension, count, order_.device(Access::write));
    if (number == 0) return;
    left = order_.host().data();
  }
  std::array<double*, 3> position{};
  std::array<std::int32_t*, 3> image{};
  for (std::size_t d = 0; d < 3; ++d) {
    position[d] = particles.position[d].host(Access::read_write).data();
    image[d] = particles.images[d].host(Access::read_write).data();
  }
  const auto move_inside = [&](Index i) {
    std::array<double, 3> at{};
    std::array<std::int32_t, 3> images{};
    for (int d = 0; d < scene_.dimension; ++d) {
      at[d] = position[d][i];
      images[d] = image[d][i];
    }
    boundary_.keep_inside(scene_, at.data(), images.data());
    for (int d = 0; d < scene_.dimension; ++d) {
      position[d][i] = at[d];
      image[d][i] = images[d];
    }
  };
  const auto strays = [&](Index i) {
    std::array<double, 3> at{};
    for (int d = 0; d < scene_.dimension; ++d) at[d] = position[d][i];
    return boundary_.strays(at.data());
  };
  exec::FirstFailure failure;
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < number; ++n) {
    const Index i = left == nullptr ? n : left[n];
    const bool in_box = exec::is_inside(position.data(), scene_.box.data(), scene_.dimension, i);
    if (in_box && !scene_.solids) continue;
    try {
      if (!in_box || strays(i)) move_inside(i);
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
  const exec::StorageLoops& loops = backend_.storage();
  find_cells(particles.position);
  order_.resize_for_overwrite(particles.id.size());
  backend_.cells().order(cell_of_.device(), particles.id.device(), count, grid_.inside_count(),
                         order_.device(Access::write));
  const auto permute = [&]<class T>(exec::Array<T>& values, exec::Array<T>& scratch) {
    scratch.resize_for_overwrite(values.size());
    loops.gather(values.device(), order_.device(), count, scratch.device(Access::write));
    values.swap(scratch);
  };
  permute(particles.id, scratch_.id);
  for (int d = 0; d < scene_.dimension; ++d) {
    permute(particles.position[d], scratch_.position);
    permute(particles.images[d], scratch_.images);
    sorted_position_[d].resize_for_overwrite(particles.id.size());
    loops.copy(particles.position[d].device(), sorted_position_[d].device(Access::write), count);
  }
  sorted_ = true;
  ++sortings_;
}

}  // namespace mesogen
