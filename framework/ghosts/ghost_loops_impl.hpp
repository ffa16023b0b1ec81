#pragma once

#include "ghosts/ghost_loops.hpp"
#include "ghosts/images.hpp"
#include "neighbours/cell_grid.hpp"
#include "particles/components.hpp"

/// The loops over ghosts, compiled twice: by g++ for the host, by nvcc for CUDA.
///
/// How ghosts are made: particle by particle each counts its images that the box can see, a running sum of the counts
/// tells where it writes them, and the ghosts are then put in order by cell. So their order does not depend on the
/// number of threads.
namespace mesogen::exec {

struct CountGhosts {
  ImageSearch search;
  Index* number;

  MESOGEN_HOST_DEVICE void operator()(Index i) const { number[i] = search.count(i); }
};

struct ListGhosts {
  ImageSearch search;
  CellGrid grid;
  const Index* begin;  // where each particle writes
  GhostArrays to;
  std::int64_t* number;  // of each ghost in this order

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    if (search.in_middle(i)) return;
    double offset[3] = {};
    Index n = begin[i];
    for (int image = 0; image < search.images_of(i); ++image) {
      if (!search.sees(image, i, offset)) continue;
      CellGrid::Cell cell{};
      for_axes(search.dimension, [&](int d) {
        cell[d] = grid.beside(d, search.position(d, i) + offset[d], search.boxes(image, d));
        to.offset[d][n] = offset[d];
      });
      to.source[n] = i;
      to.image[n] = static_cast<std::uint8_t>(image);
      to.cell[n] = grid.padded_index(cell);
      number[n] = n;
      ++n;
    }
  }
};

/// Place n takes the ghost that stands at order[n].
struct OrderGhosts {
  CellGrid grid;
  GhostArrays from;
  const Index* order;
  GhostArrays to;
  std::array<double*, 3> origin;  // of the tiles of their cells

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index at = order[n];
    to.source[n] = from.source[at];
    to.image[n] = from.image[at];
    to.cell[n] = from.cell[at];
    const CellGrid::Cell cell = grid.padded(from.cell[at]);
    for_axes(grid.dimension(), [&](int d) {
      to.offset[d][n] = from.offset[d][at];
      origin[d][n] = grid.tile_origin(d, cell[d]);
    });
  }
};

/// The i-th ghost ends all cells before its own that are not ended yet, and begins what follows them; one behind the
/// last ends the rest. Ghosts may lie in any cell.
struct FindGhostRanges {
  const Index* cell;
  Index count;
  Index first_place;
  int cells;
  Index* begin;
  Index* end;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const int first = n == 0 ? 0 : cell[n - 1] + 1;
    const int last = n == count ? cells : cell[n];
    for (int c = first; c <= last; ++c) {
      if (c > 0) end[c - 1] = first_place + n;
      if (c < cells) begin[c] = first_place + n;
    }
  }
};

/// Values of ghosts: those of their sources.
template <class Real>
struct CopyToGhosts {
  FieldView<Real> field;
  int components;
  GhostView ghosts;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index from = ghosts.place_of_source(n);
    for (int c = 0; c < components; ++c) field(c, ghosts.first + n) = field(c, from);
  }
};

/// The same by the rules of their images.
template <class Real, int Components>
struct RefreshGhosts {
  FieldView<Real> field;
  GhostView ghosts;
  RuleView rules;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index from = ghosts.place_of_source(n);
    const Index to = ghosts.first + n;
    double value[Components];
    unroll<Components>([&](auto c) { value[c] = static_cast<double>(field(c, from)); });
    rules.apply(ghosts.image[n], value, Number<Components>{});
    unroll<Components>([&](auto c) { field(c, to) = static_cast<Real>(value[c]); });
  }
};

class GhostLoopsImpl final : public GhostLoops {
 public:
  explicit GhostLoopsImpl(const Space& space) : space_(space) {}

  void count(const ImageSearch& search, Index particles, Index* number) const override {
    for_each(space_, particles, CountGhosts{search, number}, "counting ghosts");
  }
  void list(const ImageSearch& search, const CellGrid& grid, Index particles, const Index* begin, const GhostArrays& to,
            std::int64_t* number) const override {
    for_each(space_, particles, ListGhosts{search, grid, begin, to, number}, "listing ghosts");
  }
  void order(const CellGrid& grid, const GhostArrays& from, const Index* order, Index count, const GhostArrays& to,
             const std::array<double*, 3>& origin) const override {
    for_each(space_, count, OrderGhosts{grid, from, order, to, origin}, "putting ghosts in order");
  }
  void find_ranges(const CellGrid& grid, const Index* cell, Index count, Index first, Index* begin,
                   Index* end) const override {
    for_each(space_, count + 1, FindGhostRanges{cell, count, first, grid.padded_count(), begin, end},
             "the ghosts of cells");
  }
  void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<float> field, int components) const override {
    refresh_field(ghosts, rules, field, components);
  }
  void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<double> field, int components) const override {
    refresh_field(ghosts, rules, field, components);
  }

 private:
  template <class Real>
  void refresh_field(const GhostView& ghosts, const RuleView& rules, FieldView<Real> field, int components) const {
    constexpr const char* what = "values of ghosts";
    if (!rules) return for_each(space_, ghosts.count, CopyToGhosts<Real>{field, components, ghosts}, what);
    for_components(components, [&]<int N>() {
      for_each(space_, ghosts.count, RefreshGhosts<Real, N>{field, ghosts, rules}, what);
    });
  }

  Space space_;
};

}  // namespace mesogen::exec
