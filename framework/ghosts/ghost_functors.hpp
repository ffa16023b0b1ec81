#pragma once

#include "exec/backend.hpp"
#include "ghosts/images.hpp"
#include "neighbours/cell_grid.hpp"

/// How ghosts are made: particle by particle each counts its images that the box can see, a running sum of the counts
/// tells where it writes them, and the ghosts are then put in order by cell. So their order does not depend on the
/// number of threads.
namespace mesogen::exec {

struct CountGhosts {
  ImageSearch search;
  Index* number;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    double offset[3];
    number[i] = 0;
    for (int image = 0; image < search.images.count; ++image)
      if (search.sees(image, i, offset)) ++number[i];
  }
};

struct ListGhosts {
  ImageSearch search;
  CellGrid grid;
  const Index* begin;  // where each particle writes
  GhostArrays to;
  std::int64_t* number;  // of each ghost in this order

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    double offset[3];
    Index n = begin[i];
    for (int image = 0; image < search.images.count; ++image) {
      if (!search.sees(image, i, offset)) continue;
      CellGrid::Cell cell{};
      for (int d = 0; d < search.dimension; ++d) {
        cell[d] = grid.beside(d, search.position[d][i] + offset[d], search.images.boxes[image][d]);
        to.offset[d][n] = offset[d];
      }
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
    for (int d = 0; d < grid.dimension(); ++d) {
      to.offset[d][n] = from.offset[d][at];
      origin[d][n] = grid.tile_origin(d, cell[d]);
    }
  }
};

/// Values of ghosts: those of their sources, by the rules of their images.
template <class Real>
struct RefreshGhosts {
  FieldView<Real> field;
  int components;
  GhostView ghosts;
  RuleView rules;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index from = ghosts.source[n];
    const Index to = ghosts.first + n;
    if (!rules) {
      for (int c = 0; c < components; ++c) field(c, to) = field(c, from);
      return;
    }
    double value[AffineRule::most];
    for (int c = 0; c < components; ++c) value[c] = static_cast<double>(field(c, from));
    rules.apply(ghosts.image[n], value);
    for (int c = 0; c < components; ++c) field(c, to) = static_cast<Real>(value[c]);
  }
};

template <class Real>
struct PlaceGhosts {
  int dimension;
  Placing<Real> p;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    for (int d = 0; d < dimension; ++d)
      p.local[d][p.ghosts.first + n] =
          Real(p.position[d][p.ghosts.source[n]] + p.ghosts.offset[d][n] - p.ghosts.origin[d][n]);
  }
};

template <class Real>
struct PlaceWalls {
  int dimension;
  Placing<Real> p;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    for (int d = 0; d < dimension; ++d)
      p.local[d][p.walls.first + n] = Real(p.walls.position[d][n] - p.walls.origin[d][n]);
  }
};

}  // namespace mesogen::exec
