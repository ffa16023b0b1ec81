#pragma once

#include <array>
#include <cmath>

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

/// Where the images of points lie that the box can see.
struct ImageSearch {
  Images images;
  const double* position[3];  ///< in the box, m
  double box[3];              ///< m
  int dimension;
  double reach;        ///< how far beyond the faces, m
  bool middle_unseen;  ///< the box sees no image of a point that is farther than `reach` from every face

  /// Is point i so far from every face that the box sees no image of it?
  [[nodiscard]] MESOGEN_HOST_DEVICE bool in_middle(Index i) const {
    bool inside = middle_unseen;
    exec::for_axes(dimension,
                   [&](int d) { inside = inside && position[d][i] >= reach && position[d][i] < box[d] - reach; });
    return inside;
  }
  /// Does the image of point i lie within reach of the box? Then `offset` (m) is its position minus that of the point.
  MESOGEN_HOST_DEVICE bool sees(int image, Index i, double (&offset)[3]) const {
    bool seen = true;
    exec::for_axes(dimension, [&](int d) {
      double at = position[d][i];
      double moved = images.shear[image][d];
      if (moved != 0.0) {
        // What shear carries past a face comes in at the opposite one.
        moved -= ::floor((at + moved) / box[d]) * box[d];
        at += moved;
      }
      const int boxes = images.boxes[image][d];
      seen = seen && (boxes <= 0 || at < reach) && (boxes >= 0 || at >= box[d] - reach);
      offset[d] = moved + boxes * box[d];
    });
    return seen;
  }

  /// How many images of point i the box can see.
  [[nodiscard]] MESOGEN_HOST_DEVICE Index count(Index i) const {
    if (in_middle(i)) return 0;
    Index number = 0;
    double offset[3] = {};
    for (int image = 0; image < images.count; ++image)
      if (sees(image, i, offset)) ++number;
    return number;
  }
};

ImageSearch image_search(const Scene& scene, const Images& images, const double* const* position, double reach);

/// How many ghosts points have; `position[d]` points to the coordinates of all.
MESOGEN_EXPORT Index count_ghosts(const Scene& scene, const Images& images, const double* const* position, Index count,
                                  double reach);

}  // namespace mesogen
