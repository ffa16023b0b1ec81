#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "ghosts/views.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// The images of the box next to it, along all axes that continue by ghosts and their combinations.
MESOGEN_EXPORT Images images_of(const Scene& scene, const Boundary& boundary);

inline std::array<int, 3> boxes_of(const Images& images, int image) {
  const auto& boxes = images.boxes[image];
  return {boxes[0], boxes[1], boxes[2]};
}

/// A slab of a box along one axis, m: what the particles of one rank see. Of a whole box it has no ends.
struct Slab {
  int axis = 0;
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  [[nodiscard]] MESOGEN_HOST_DEVICE bool holds(double at) const { return at >= begin && at < end; }
};

/// Where the images of points lie that the box can see, or a slab of it. Points from number `own` on are those of other
/// ranks: they are seen as images, and where they are.
struct ImageSearch {
  Images images;
  const double* of_own[3];     ///< positions in the box, m
  const double* of_others[3];  ///< likewise
  Index own;
  Slab slab;
  double box[3];  ///< m
  int dimension;
  double reach;        ///< how far beyond the faces, m
  bool middle_unseen;  ///< the box sees no image of a point that is farther than `reach` from every face

  [[nodiscard]] MESOGEN_HOST_DEVICE double position(int axis, Index i) const {
    return i < own ? of_own[axis][i] : of_others[axis][i - own];
  }
  /// How many images a point has; itself is the last, and one only for others.
  [[nodiscard]] MESOGEN_HOST_DEVICE int images_of(Index i) const { return images.count + (i < own ? 0 : 1); }
  /// How many boxes away an image of a point lies.
  [[nodiscard]] MESOGEN_HOST_DEVICE int boxes(int image, int axis) const {
    return image == images.count ? 0 : images.boxes[image][axis];
  }

  /// Is point i so far from every face that the box sees no image of it?
  [[nodiscard]] MESOGEN_HOST_DEVICE bool in_middle(Index i) const {
    bool inside = middle_unseen && i < own;
    exec::for_axes(dimension,
                   [&](int d) { inside = inside && of_own[d][i] >= reach && of_own[d][i] < box[d] - reach; });
    return inside;
  }
  /// Does the image of point i lie within reach of the box? Then `offset` (m) is its position minus that of the point.
  MESOGEN_HOST_DEVICE bool sees(int image, Index i, double (&offset)[3]) const {
    bool seen = true;
    const bool itself = image == images.count;
    exec::for_axes(dimension, [&](int d) {
      double at = position(d, i);
      double moved = itself ? 0.0 : images.shear[image][d];
      if (moved != 0.0) {
        // What shear carries past a face comes in at the opposite one.
        moved -= ::floor((at + moved) / box[d]) * box[d];
        at += moved;
      }
      const int away = boxes(image, d);
      seen = seen && (away <= 0 || at < reach) && (away >= 0 || at >= box[d] - reach);
      if (d == slab.axis) seen = seen && slab.holds(at + away * box[d]);
      offset[d] = moved + away * box[d];
    });
    return seen;
  }

  /// How many images of point i the box can see.
  [[nodiscard]] MESOGEN_HOST_DEVICE Index count(Index i) const {
    if (in_middle(i)) return 0;
    Index number = 0;
    double offset[3] = {};
    for (int image = 0; image < images_of(i); ++image)
      if (sees(image, i, offset)) ++number;
    return number;
  }
};

/// Of `own` points at these coordinates, without any of others.
MESOGEN_EXPORT ImageSearch image_search(const Scene& scene, const Images& images, const double* const* position,
                                        Index own, double reach);

/// How many ghosts points have; `position[d]` points to the coordinates of all.
MESOGEN_EXPORT Index count_ghosts(const Scene& scene, const Images& images, const double* const* position, Index count,
                                  double reach);

}  // namespace mesogen
