#include "boundary_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ghosts/ghosts.hpp"
#include "neighbours/cell_grid.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {

Scene scene_of(int dimension, std::array<double, 3> box) {
  Scene scene;
  scene.dimension = dimension;
  scene.box = box;
  return scene;
}

Points lattice(const Scene& scene, int cells) {
  Points points;
  const int layers = scene.dimension == 3 ? cells : 1;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        points[0].push_back((i + 0.5) * scene.box[0] / cells);
        points[1].push_back((j + 0.5) * scene.box[1] / cells);
        points[2].push_back(scene.dimension == 3 ? (k + 0.5) * scene.box[2] / cells : 0.0);
      }
  return points;
}

Points scattered(const Scene& scene, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  Points points;
  for (unsigned d = 0; d < 3; ++d)
    for (int i = 0; i < count; ++i)
      points[d].push_back(d < static_cast<unsigned>(scene.dimension)
                              ? scene.box[d] * std::generate_canonical<double, 53>(random)
                              : 0.0);
  return points;
}

GhostList ghosts_of(const Boundary& boundary, const Scene& scene, const Points& points, double reach) {
  const Backend& backend = Backend::host();
  Ghosts ghosts(images_of(scene, boundary), false, backend);
  auto position = exec::axis_arrays<double>(nullptr);
  for (std::size_t d = 0; d < 3; ++d) position[d].assign(points[d]);
  const auto count = static_cast<Index>(points[0].size());
  const auto at = exec::pointers(position, exec::Side::host);
  ghosts.build(CellGrid(scene, boundary, reach), image_search(scene, ghosts.images(), at.data(), count, reach), count,
               0);
  const GhostView view = ghosts.view(0, exec::Side::host);
  GhostList list;
  for (Index n = 0; n < ghosts.count(); ++n) {
    list.source.push_back(view.source[n]);
    list.offset.push_back({});
    for (int d = 0; d < scene.dimension; ++d) list.offset.back()[static_cast<std::size_t>(d)] = view.offset[d][n];
  }
  return list;
}

void expect_keeps_inside(const std::string& name) {
  const auto boundary = built_plugins().make_boundary(name, 2);
  const Scene scene = scene_of(2, {10.0, 0.3, 0.0});
  for (unsigned axis = 0; axis < 2; ++axis) {
    const double length = scene.box[axis];
    for (const double coordinate : {0.0, 0.5 * length, std::nextafter(length, 0.0), length, std::nextafter(length, 1e9),
                                    -1e-18, -std::numeric_limits<double>::denorm_min(), -0.25 * length, 1.25 * length,
                                    -3.0 * length, 7.0 * length, -1234.5 * length, 98765.25 * length}) {
      std::array<double, 2> position{0.1, 0.1};
      std::array<std::int32_t, 2> images{0, 0};
      position[axis] = coordinate;
      images[axis] = 5;
      boundary->keep_inside(scene, position.data(), images.data());
      EXPECT_GE(position[axis], 0.0) << "from " << coordinate;
      EXPECT_LT(position[axis], length) << "from " << coordinate;
      EXPECT_NEAR(position[axis] + (images[axis] - 5) * length, coordinate, 4e-16 * (std::abs(coordinate) + length));
      EXPECT_EQ(images[1 - axis], 0);
      EXPECT_EQ(position[1 - axis], 0.1);
    }
  }
  std::array<double, 2> position{-0.5, 0.1};
  std::array<std::int32_t, 2> images{0, 0};
  boundary->keep_inside(scene, position.data(), images.data());
  EXPECT_EQ(images[0], -1);
  EXPECT_EQ(position[0], 9.5);
  // Not a place: left for the checks of the run to report, and no undefined conversion to an integer on the way.
  for (const double nowhere : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
    position[0] = nowhere;
    images[0] = 3;
    boundary->keep_inside(scene, position.data(), images.data());
    EXPECT_EQ(images[0], 3);
    EXPECT_TRUE(std::isnan(nowhere) ? std::isnan(position[0]) : position[0] == nowhere);
  }
}

}  // namespace mesogen::test
