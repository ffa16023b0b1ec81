#include "ghosts/neighbourhood.hpp"

#include <algorithm>
#include <cmath>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/first_failure.hpp"
#include "neighbours/cell_loops.hpp"
#include "neighbours/outside.hpp"
#include "particles/storage_loops.hpp"
#include "sph/pair_loops.hpp"

namespace mesogen {

namespace {

// Pair loops read whole packs.
constexpr std::size_t pack_tail = 16;

constexpr auto device = exec::Side::device;
using exec::Access;

}  // namespace

Neighbourhood::Neighbourhood(const Scene& scene, const Boundary& boundary, const Backend& backend, const Ranks& ranks)
    : scene_(scene),
      boundary_(boundary),
      backend_(backend),
      ranks_(ranks),
      skin_(skin_in_spacings * scene.spacing),
      grid_(scene, boundary, scene.support + skin_),
      parts_(grid_, ranks.count()),
      sorted_position_(exec::axis_arrays<double>(backend.memory())),
      order_(backend.memory()),
      cell_of_(backend.memory()),
      cell_begin_(backend.memory()),
      cell_end_(backend.memory()),
      blocks_wanted_(backend.has_host_code()),
      run_begin_(backend.memory()),
      run_(backend.memory()),
      ghosts_(images_of(scene, boundary), ranks.several(), backend),
      halo_(ranks, backend),
      local_single_(exec::axis_arrays<float>(backend.memory())),
      local_double_(exec::axis_arrays<double>(backend.memory())),
      scratch_(backend.memory()) {
  cell_begin_.resize(static_cast<std::size_t>(grid_.padded_count()));
  cell_end_.resize(static_cast<std::size_t>(grid_.padded_count()));
  make_walls();
}

// A rank finds the values of all walls that its particles see by itself. Their mirror points lie up to two ranges of
// neighbours farther away, and each looks around itself.
void Neighbourhood::make_walls() {
  const int axis = parts_.axis();
  const int reach = grid_.reach(axis);
  const auto seen = [&](const CellGrid::Cell& cell) {
    return parts_.sees(ranks_.rank(), reach, cell[static_cast<std::size_t>(axis)]);
  };
  walls_.emplace(scene_, boundary_, grid_, ghosts_.images(), scene_.support + skin_, backend_.memory(),
                 ranks_.several() ? WallSet::Seen(seen) : WallSet::Seen());
  mirrors_.emplace(scene_, boundary_, grid_, walls_->members(), backend_);
  rows_seen_ = walls_->anywhere() ? 4 * reach : reach;
  ++walls_version_;
}

GhostView Neighbourhood::ghost_view(exec::Side side) const {
  GhostView view = ghosts_.view(own() + walls_->count(), side);
  const auto of_others = exec::pointers(halo_.position(), side);
  std::ranges::copy(of_others, view.of_others);
  return view;
}

const exec::Array<Index>& Neighbourhood::sort(Particles& particles) {
  order(particles);
  find_neighbours();
  return order_;
}

bool Neighbourhood::update(const Particles& particles, double farthest) {
  ++version_;
  if (!sorted_ || !place(particles.position, farthest)) return false;
  if (!neighbours_found_) {
    find_neighbours();
    (void)place(particles.position, 0.0);
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
  find_cells(sorted_position_);
  build_ghosts(particles);
  neighbours_found_ = false;
}

void Neighbourhood::restore(const Particles& particles, const std::array<std::vector<double>, 3>& sorted_position) {
  ++version_;
  for (int d = 0; d < scene_.dimension; ++d) sorted_position_[d].assign(sorted_position[d]);
  sorted_ = true;
  find_cells(sorted_position_);
  build_ghosts(particles);
  neighbours_found_ = false;
}

// Wherever particles are by now, their neighbours are those of the last sorting. Leaves the particles placed there.
void Neighbourhood::find_neighbours() {
  neighbours_found_ = true;
  (void)place(sorted_position_, 0.0);
  dispatch(scene_.precision, scene_.dimension, [&]<class Real, int Dim>() {
    if (!backend_.has_host_code()) find_runs<Real, Dim>();
    if (blocks_wanted_) blocks_.find(seen_from<Real, Dim>(exec::Side::host), neighbour_range());
    // A mirror point does not move.
    if (walls_->count() > 0) mirrors_->find(seen_from<Real, Dim>(mirrors_->side()), scene_.support + 0.51 * skin_);
  });
}

template <class Real, int Dim>
void Neighbourhood::find_runs() {
  Neighbours<Real, Dim> grid = seen_from<Real, Dim>(device);
  const exec::PairLoops<Real>& loops = backend_.pairs<Real>();
  run_begin_.resize_for_overwrite(cell_of_.size() + 1);
  loops.count_runs(grid, neighbour_range(), run_begin_.device(Access::write));
  const Index runs = backend_.cells().running_sums(run_begin_.device(Access::read_write), grid.particle_count);
  run_.resize_for_overwrite(static_cast<std::size_t>(runs));
  grid.run_begin = run_begin_.device();
  loops.list_runs(grid, neighbour_range(), run_.device(Access::write));
}

void Neighbourhood::find_cells(const exec::AxisArrays<double>& position) {
  const std::size_t count = position[0].size();
  cell_of_.resize_for_overwrite(count);
  backend_.cells().find_cells(grid_, exec::pointers(position, device).data(), static_cast<Index>(count),
                              cell_of_.device(Access::write));
}

// Ghosts are found by cell as particles are; those of the walls have tables of their own. Cells beyond the faces keep
// what they had where there are no ghosts: nothing.
void Neighbourhood::build_ghosts(const Particles& particles) {
  const Index count = own();
  const auto at = exec::pointers(sorted_position_, device);
  ImageSearch search = image_search(scene_, ghosts_.images(), at.data(), count, scene_.support + skin_);
  if (ranks_.several()) {
    halo_.find(parts_, search, cell_of_, rows_seen_, particles.id.host());
    halo_.bring_positions(sorted_position_, scene_.dimension);
    std::ranges::copy(exec::pointers(halo_.position(), device), search.of_others);
    search.slab = parts_.slab(ranks_.rank(), rows_seen_);
  }
  ghosts_.build(grid_, search, count, halo_.count());
  walls_->move_to(count);
  Index* const begin = cell_begin_.device(Access::read_write);
  Index* const end = cell_end_.device(Access::read_write);
  if (ghosts_.possible())
    backend_.ghosts().find_ranges(grid_, ghosts_.cell().device(), ghosts_.count(), count + walls_->count(), begin, end);
  backend_.cells().find_ranges(grid_, parts_.cells(ranks_.rank()), cell_of_.device(), count, begin, end);
  make_room();
}

// All but the last few are written by place().
void Neighbourhood::make_room() {
  const std::size_t stored = cell_of_.size() + static_cast<std::size_t>(walls_->count() + ghosts_.count());
  const auto resize = [&](auto& local) {
    local.resize_for_overwrite(stored + pack_tail);
    local.zero(stored);
  };
  for (int d = 0; d < scene_.dimension; ++d)
    dispatch(scene_.precision, [&]<class Real>() { resize(local<Real>()[d]); });
}

bool Neighbourhood::must_look(double farthest) const {
  constexpr double rounded = 1.0 - 1e-6;  // of sums that led to `farthest`
  return !(farthest < rounded * skin_ / 2.0);
}

// Coordinates relative to tiles.
template <class Real>
exec::PlaceArguments<Real> Neighbourhood::placing(const double* const* position, bool looks) {
  exec::PlaceArguments<Real> arguments{};
  for (int d = 0; d < scene_.dimension; ++d) {
    arguments.position[d] = position[d];
    arguments.sorted[d] = sorted_position_[d].device();
    arguments.local[d] = local<Real>()[d].device(Access::read_write);  // but for those behind the last
  }
  arguments.count = own();
  arguments.cell = cell_of_.device();
  arguments.cell_begin = cell_begin_.device();
  arguments.cell_end = cell_end_.device();
  arguments.cells = parts_.cells(ranks_.rank());
  arguments.looks = looks;
  arguments.farthest_square = skin_ * skin_ / 4.0;
  arguments.walls = wall_view(device);
  arguments.ghosts = ghost_view(device);
  return arguments;
}

// False if a particle has left the skin, which is looked for where it may have.
bool Neighbourhood::place(const exec::AxisArrays<double>& position, double farthest) {
  if (ranks_.several()) halo_.bring_positions(position, scene_.dimension);
  const auto at = exec::pointers(position, device);
  const bool looks = must_look(farthest);
  const bool placed = dispatch(
      scene_.precision, [&]<class Real>() { return backend_.cells().place(grid_, placing<Real>(at.data(), looks)); });
  return looks ? !any(ranks_, !placed) : placed;
}

template <class Real, template <class> class Arguments>
bool Neighbourhood::move(const Arguments<Real>& arguments, double farthest) {
  if (backend_.has_host_code() || ranks_.several() || !neighbours_found_ || !sorted() || must_look(farthest))
    return false;
  ++version_;
  backend_.cells().move_and_place(grid_, arguments, placing<Real>(arguments.position, false));
  return true;
}
template bool Neighbourhood::move(const exec::MoveArguments<float>&, double);
template bool Neighbourhood::move(const exec::MoveArguments<double>&, double);
template bool Neighbourhood::move(const exec::MoveByPassesArguments<float>&, double);
template bool Neighbourhood::move(const exec::MoveByPassesArguments<double>&, double);

}  // namespace mesogen
