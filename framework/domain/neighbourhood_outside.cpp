// What lies beyond the faces of the box, and where everybody is found by cell.

#include <algorithm>
#include <numeric>

#include "domain/neighbourhood.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

// Pair loops read whole packs.
constexpr std::size_t pack_tail = 16;

}  // namespace

// What lies beyond the faces is stored behind the particles, by cell like them; its cells lie in the padding.
void Neighbourhood::make_outside() {
  const auto count = static_cast<Index>(sorted_position_[0].size());
  const double* const position[3] = {sorted_position_[0].data(), sorted_position_[1].data(),
                                     sorted_position_[2].data()};
  Copies made;
  backend_.finish();
  boundary_.copies(scene_, position, count, scene_.support + skin_, made);
  if (!made.source.empty() && !dummies_.position.empty())
    throw Error(
        ExitCode::plugin_refused,
        "the boundary gives copies and dummies: it can have one or the other; an axis that wraps needs neither");
  std::vector<CellGrid::Cell> cell;
  for (std::size_t n = 0; n < made.source.size(); ++n)
    cell.push_back(grid_.of_copy(sorted_at(made.source[n]), made.offset[n]));
  for (const auto& at : dummies_.position) cell.push_back(grid_.of_dummy(at));

  const std::vector<Index> order = order_outside(cell);
  const auto permuted = [&](auto& from) {
    auto to = from;
    for (std::size_t n = 0; n < to.size(); ++n) to[n] = from[static_cast<std::size_t>(order[n])];
    return to;
  };
  if (dummies_.position.empty()) {
    copies_.source = permuted(made.source);
    copies_.offset = permuted(made.offset);
  } else {
    dummies_.position = permuted(dummies_.position);
    dummies_.mirror = permuted(dummies_.mirror);
  }

  copy_source_.assign(copies_.source.begin(), copies_.source.end());
  const std::size_t stored = static_cast<std::size_t>(count) + cell.size() + pack_tail;
  for (int d = 0; d < scene_.dimension; ++d) {
    copy_offset_[d].clear();
    for (const auto& offset : copies_.offset) copy_offset_[d].push_back(offset[d]);
    outside_origin_[d].resize(cell.size());
    for (std::size_t n = 0; n < cell.size(); ++n)
      outside_origin_[d][n] = grid_.tile_origin(d, cell[static_cast<std::size_t>(order[n])][d]);
    const auto place_dummies = [&](auto& local) {
      using Real = typename std::decay_t<decltype(local)>::value_type;
      // Copies come and go: a little room keeps the array where it is.
      if (local.capacity() < stored) local.reserve(stored + stored / 16);
      local.resize(stored);
      std::fill(local.begin() + count, local.end(), Real(0));
      for (std::size_t n = 0; n < dummies_.position.size(); ++n)
        local[static_cast<std::size_t>(count) + n] = Real(dummies_.position[n][d] - outside_origin_[d][n]);
    };
    if (scene_.precision == Precision::single_precision) {
      place_dummies(local_single_[d]);
    } else {
      place_dummies(local_double_[d]);
    }
  }
  ++sorted_version_;
}

// By cell, and as they came within a cell; fills the cell tables.
std::vector<Index> Neighbourhood::order_outside(const std::vector<CellGrid::Cell>& cell) {
  std::vector<Index> begin(static_cast<std::size_t>(grid_.padded_count()) + 1, 0);
  for (const auto& at : cell) ++begin[static_cast<std::size_t>(grid_.padded_index(at)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  std::vector<Index> order(cell.size());
  for (std::size_t n = 0; n < cell.size(); ++n)
    order[static_cast<std::size_t>(next[static_cast<std::size_t>(grid_.padded_index(cell[n]))]++)] =
        static_cast<Index>(n);
  fill_cell_tables(begin);
  return order;
}

void Neighbourhood::fill_cell_tables(const std::vector<Index>& outside_begin) {
  const auto count = static_cast<Index>(cell_of_.size());
  cell_begin_.resize(outside_begin.size() - 1);
  cell_end_.resize(outside_begin.size() - 1);
  for (std::size_t c = 0; c < cell_begin_.size(); ++c) {
    cell_begin_[c] = count + outside_begin[c];
    cell_end_[c] = count + outside_begin[c + 1];
  }
  backend_.cells().find_ranges(grid_, cell_of_.data(), count, cell_begin_.data(), cell_end_.data());
}

}  // namespace mesogen
