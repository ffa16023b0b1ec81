#include "domain/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mesogen {

namespace {

constexpr double skin_in_spacings = 0.1;
constexpr int cells_in_tile = 64;
constexpr std::size_t pack_tail = 16;
// Cells along x are a fraction of the support: short ones waste fewer pairs, long ones fewer loop turns.
constexpr int narrow = 4;

}  // namespace

Neighbourhood::Neighbourhood(const Scene& scene, const Boundary& boundary)
    : scene_(scene), boundary_(boundary), skin_(skin_in_spacings * scene.spacing) {
  choose_cells();
}

void Neighbourhood::choose_cells() {
  const double range = scene_.support + skin_;
  for (int d = 0; d < scene_.dimension; ++d) {
    const double wanted = d == 0 ? range / narrow : range;
    cells_[d] = std::max(1, static_cast<int>(std::floor(scene_.box[d] / wanted)));
    width_[d] = scene_.box[d] / cells_[d];
    reach_[d] = static_cast<int>(std::ceil(range / width_[d] * (1.0 - 1e-12)));
    wrapped_[d] = boundary_.wraps(d);
    padding_[d] = wrapped_[d] ? 0 : reach_[d];
  }
}

int Neighbourhood::cell_along(int axis, double position) const {
  return static_cast<int>(std::floor(position / width_[axis]));
}

int Neighbourhood::padded(const std::array<int, 3>& cell) const {
  int index = 0;
  for (int d = scene_.dimension - 1; d >= 0; --d) index = index * (cells_[d] + 2 * padding_[d]) + cell[d] + padding_[d];
  return index;
}

double Neighbourhood::tile_origin(int axis, int cell) const {
  if (axis > 0) return cell * width_[axis];
  if (cell < 0) return -padding_[0] * width_[0];
  if (cell >= cells_[0]) return cells_[0] * width_[0];
  return cell / cells_in_tile * cells_in_tile * width_[0];
}

const std::vector<Index>* Neighbourhood::update(Particles& particles) {
  ++version_;
  if (!cell_of_.empty() && place(particles)) return nullptr;
  sort_particles(particles);
  find_cells();
  make_copies();
  (void)place(particles);
  return &order_;
}

void Neighbourhood::restore(const Particles& particles, std::array<std::vector<double>, 3> sorted_position) {
  ++version_;
  sorted_position_ = std::move(sorted_position);
  find_cells();
  make_copies();
  (void)place(particles);
}

// Storage goes by cell, and by id within a cell: the order of sums depends on positions alone.
void Neighbourhood::sort_particles(Particles& particles) {
  const Index count = particles.count();
  const int dimension = scene_.dimension;
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < count; ++i) {
    std::array<double, 3> at{};
    std::array<std::int32_t, 3> images{};
    for (int d = 0; d < dimension; ++d) {
      at[d] = particles.position[d][i];
      images[d] = particles.images[d][i];
    }
    boundary_.keep_inside(scene_, at.data(), images.data());
    for (int d = 0; d < dimension; ++d) {
      particles.position[d][i] = at[d];
      particles.images[d][i] = images[d];
    }
  }
  for (int d = 0; d < dimension; ++d) sorted_position_[d] = particles.position[d];
  find_cells();
  int cells = 1;
  for (int d = 0; d < dimension; ++d) cells *= cells_[d];
  std::vector<Index> start(static_cast<std::size_t>(cells) + 1, 0);
  for (const Index cell : cell_of_) ++start[static_cast<std::size_t>(cell) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  order_.resize(static_cast<std::size_t>(count));
  std::vector<Index> next(start.begin(), start.end() - 1);
  for (Index i = 0; i < count; ++i) order_[next[cell_of_[i]]++] = i;
  const auto& id = particles.id;
#pragma omp parallel for schedule(static)
  for (int cell = 0; cell < cells; ++cell)
    std::sort(order_.begin() + start[cell], order_.begin() + start[cell + 1],
              [&](Index a, Index b) { return id[a] < id[b]; });

  const auto permute = [&](auto& values) {
    auto moved = values;
#pragma omp parallel for schedule(static)
    for (Index n = 0; n < count; ++n) moved[n] = values[order_[n]];
    values.swap(moved);
  };
  permute(particles.id);
  for (int d = 0; d < dimension; ++d) {
    permute(particles.position[d]);
    permute(particles.images[d]);
    permute(sorted_position_[d]);
  }
  ++sortings_;
}

void Neighbourhood::find_cells() {
  const auto count = static_cast<Index>(sorted_position_[0].size());
  cell_of_.resize(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < count; ++i) {
    int cell = 0;
    for (int d = scene_.dimension - 1; d >= 0; --d)
      cell = cell * cells_[d] + std::clamp(cell_along(d, sorted_position_[d][i]), 0, cells_[d] - 1);
    cell_of_[i] = cell;
  }
}

// Copies are stored behind the particles, by cell like them; their cells lie in the padding.
void Neighbourhood::make_copies() {
  const auto count = static_cast<Index>(sorted_position_[0].size());
  const int dimension = scene_.dimension;
  const double* position[3] = {sorted_position_[0].data(), sorted_position_[1].data(), sorted_position_[2].data()};
  Copies made;
  boundary_.copies(scene_, position, count, scene_.support + skin_, made);
  const auto copies = static_cast<Index>(made.source.size());

  int padded_count = 1;
  for (int d = 0; d < dimension; ++d) padded_count *= cells_[d] + 2 * padding_[d];
  cell_begin_.assign(static_cast<std::size_t>(padded_count), 0);
  cell_end_.assign(static_cast<std::size_t>(padded_count), 0);

  std::vector<Index> begin(static_cast<std::size_t>(padded_count) + 1, 0);
  std::vector<std::array<int, 3>> cell(made.source.size());
  for (Index n = 0; n < copies; ++n) {
    for (int d = 0; d < dimension; ++d) {
      const double at = sorted_position_[d][made.source[n]] + made.offset[n][d];
      cell[n][d] = std::clamp(cell_along(d, at), -padding_[d], cells_[d] + padding_[d] - 1);
      // Rounding must not move a copy over a face: the cells inside the box know only particles.
      if (made.offset[n][d] < 0.0) cell[n][d] = std::min(cell[n][d], -1);
      if (made.offset[n][d] > 0.0) cell[n][d] = std::max(cell[n][d], cells_[d]);
      if (made.offset[n][d] == 0.0) cell[n][d] = std::clamp(cell[n][d], 0, cells_[d] - 1);
    }
    ++begin[padded(cell[n]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  copies_.source.resize(made.source.size());
  copies_.offset.resize(made.source.size());
  for (int d = 0; d < dimension; ++d) copy_origin_[d].resize(made.source.size());
  for (Index n = 0; n < copies; ++n) {
    const Index to = next[padded(cell[n])]++;
    copies_.source[to] = made.source[n];
    copies_.offset[to] = made.offset[n];
    for (int d = 0; d < dimension; ++d) copy_origin_[d][to] = tile_origin(d, cell[n][d]);
  }

  for (int c = 0; c < padded_count; ++c) {
    cell_begin_[c] = count + begin[c];
    cell_end_[c] = count + begin[c + 1];
  }
  Index i = 0;
  int inside = 1;
  for (int d = 0; d < dimension; ++d) inside *= cells_[d];
  for (int c = 0; c < inside; ++c) {
    std::array<int, 3> at{};
    int rest = c;
    for (int d = 0; d < dimension; ++d) {
      at[d] = rest % cells_[d];
      rest /= cells_[d];
    }
    const int index = padded(at);
    cell_begin_[index] = i;
    while (i < count && cell_of_[i] == c) ++i;
    cell_end_[index] = i;
  }
  const std::size_t stored = static_cast<std::size_t>(count) + made.source.size() + pack_tail;
  for (int d = 0; d < dimension; ++d) {
    if (scene_.precision == Precision::single_precision) {
      local_single_[d].assign(stored, 0.0F);
    } else {
      local_double_[d].assign(stored, 0.0);
    }
  }
  ++sorted_version_;
}

// Coordinates relative to tiles; false if a particle has left the skin.
template <class Real>
bool Neighbourhood::place(const Particles& particles, std::array<std::vector<Real>, 3>& local) const {
  const Index count = particles.count();
  const double most = skin_ * skin_ / 4.0;
  int left = 0;
#pragma omp parallel for schedule(static) reduction(| : left)
  for (Index i = 0; i < count; ++i) {
    double moved = 0.0;
    int rest = cell_of_[i];
    for (int d = 0; d < scene_.dimension; ++d) {
      const double at = particles.position[d][i];
      const double by = at - sorted_position_[d][i];
      moved += by * by;
      local[d][i] = Real(at - tile_origin(d, rest % cells_[d]));
      rest /= cells_[d];
    }
    // Written so that NaN counts as having left; the guard after the step names it.
    if (!(moved <= most)) left = 1;
  }
  if (left != 0) return false;
  const Index copies = copy_count();
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < copies; ++n)
    for (int d = 0; d < scene_.dimension; ++d)
      local[d][count + n] = Real(particles.position[d][copies_.source[n]] + copies_.offset[n][d] - copy_origin_[d][n]);
  return true;
}

bool Neighbourhood::place(const Particles& particles) {
  return scene_.precision == Precision::single_precision ? place(particles, local_single_)
                                                         : place(particles, local_double_);
}

template <class Real, int Dim>
void Neighbourhood::fill(Neighbours<Real, Dim>& grid) const {
  for (int d = 0; d < Dim; ++d) {
    if constexpr (sizeof(Real) == sizeof(float)) {
      grid.local[d] = local_single_[d].data();
    } else {
      grid.local[d] = local_double_[d].data();
    }
    grid.cells[d] = cells_[d];
    grid.padding[d] = padding_[d];
    grid.reach[d] = reach_[d];
    grid.wrapped[d] = wrapped_[d];
    grid.width[d] = width_[d];
  }
  grid.cell_begin = cell_begin_.data();
  grid.cell_end = cell_end_.data();
  grid.cell_of = cell_of_.data();
  grid.particle_count = static_cast<Index>(cell_of_.size());
  grid.tile = cells_in_tile;
  grid.radius = Real(scene_.support);
  const double h = scene_.smoothing_length;
  grid.smallest = Real((sizeof(Real) == sizeof(float) ? 1e-14 : 1e-30) * h * h);
}
template void Neighbourhood::fill(Neighbours<float, 2>&) const;
template void Neighbourhood::fill(Neighbours<double, 2>&) const;
template void Neighbourhood::fill(Neighbours<float, 3>&) const;
template void Neighbourhood::fill(Neighbours<double, 3>&) const;

}  // namespace mesogen
