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
  double reach;  ///< how far beyond the faces, m

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
};

ImageSearch image_search(const Scene& scene, const Images& images, const double* const* position, double reach);

/// How many ghosts points have; `position[d]` points to the coordinates of all.
MESOGEN_EXPORT Index count_ghosts(const Scene& scene, const Images& images, const double* const* position, Index count,
                                  double reach);

}  // namespace mesogen
