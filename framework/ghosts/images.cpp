#include "ghosts/images.hpp"

namespace mesogen {

Images images_of(const Scene& scene, const Boundary& boundary) {
  int most[3] = {0, 0, 0};
  for (int d = 0; d < scene.dimension; ++d) most[d] = boundary.continuation(d) == Continuation::ghosts ? 1 : 0;
  // The box itself first in each direction: 0, 1, -1.
  const auto step = [](int n) { return n == 2 ? -1 : n; };
  Images images{};
  for (int z = 0; z <= 2 * most[2]; ++z)
    for (int y = 0; y <= 2 * most[1]; ++y)
      for (int x = 0; x <= 2 * most[0]; ++x) {
        if (x + y + z == 0) continue;
        const std::array<int, 3> boxes{step(x), step(y), step(z)};
        const std::array<double, 3> shear = boundary.shear(scene, boxes);
        for (unsigned d = 0; d < 3; ++d) {
          images.boxes[images.count][d] = boxes[d];
          images.shear[images.count][d] = shear[d];
        }
        ++images.count;
      }
  return images;
}

namespace {

/// Shear carries points along a face, so it may bring them near another.
bool lies_beyond_a_face(const Images& images, int image) {
  for (int d = 0; d < 3; ++d)
    if (images.boxes[image][d] != 0 && images.shear[image][d] == 0.0) return true;
  return false;
}

}  // namespace

ImageSearch image_search(const Scene& scene, const Images& images, const double* const* position, Index own,
                         double reach) {
  bool middle_unseen = true;
  for (int image = 0; image < images.count; ++image) middle_unseen = middle_unseen && lies_beyond_a_face(images, image);
  return {images,
          {position[0], position[1], position[2]},
          {},
          own,
          {},
          {scene.box[0], scene.box[1], scene.box[2]},
          scene.dimension,
          reach,
          middle_unseen};
}

Index count_ghosts(const Scene& scene, const Images& images, const double* const* position, Index count, double reach) {
  const ImageSearch search = image_search(scene, images, position, count, reach);
  Index number = 0;
#pragma omp parallel for schedule(static) reduction(+ : number)
  for (Index i = 0; i < count; ++i) number += search.count(i);
  return number;
}

}  // namespace mesogen
