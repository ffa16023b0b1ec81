#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesogen/neighbours/point_cells.hpp"

namespace mesogen {
namespace {

template <int Dim>
std::vector<std::array<double, Dim>> random_points(const std::array<double, 3>& box, std::size_t count) {
  std::mt19937 random(3);
  std::vector<std::array<double, Dim>> points(count);
  for (auto& point : points) {
    for (std::size_t d = 0; d < Dim; ++d) point[d] = std::uniform_real_distribution<double>(0.0, box[d])(random);
  }
  return points;
}

Scene scene_of(const std::array<double, 3>& box, const std::array<bool, 3>& periodic = {true, true, true}) {
  Scene scene;
  scene.box = box;
  scene.periodic = periodic;
  return scene;
}

/// Squares of the distances to all points and images within the radius, by trying all of them.
template <int Dim>
std::vector<double> by_hand(const Scene& scene, const std::vector<std::array<double, Dim>>& points,
                            const std::array<double, Dim>& centre, double radius) {
  std::vector<double> squares;
  std::array<int, 3> most{};
  for (std::size_t d = 0; d < Dim; ++d) most[d] = scene.periodic[d] ? 4 : 0;
  for (const auto& point : points) {
    for (int c = -most[2]; c <= most[2]; ++c) {
      for (int b = -most[1]; b <= most[1]; ++b) {
        for (int a = -most[0]; a <= most[0]; ++a) {
          const std::array<int, 3> image{a, b, c};
          double square = 0.0;
          for (std::size_t d = 0; d < Dim; ++d) square += std::pow(point[d] + image[d] * scene.box[d] - centre[d], 2);
          if (square <= radius * radius) squares.push_back(square);
        }
      }
    }
  }
  std::sort(squares.begin(), squares.end());
  return squares;
}

template <int Dim>
void expect_all_found(const Scene& scene, std::size_t count, double width, double radius) {
  const auto points = random_points<Dim>(scene.box, count);
  const PointCells<Dim> cells(scene, points, width);
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 20); ++i) {
    std::vector<double> squares;
    cells.within(points[i], radius, [&](Index j, const auto& displacement, double square) {
      double length = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        length += displacement[d] * displacement[d];
        const double path = points[i][d] + displacement[d] - points[static_cast<std::size_t>(j)][d];
        EXPECT_NEAR(scene.periodic[d] ? std::remainder(path, scene.box[d]) : path, 0.0, 1e-12);
      }
      EXPECT_NEAR(length, square, 1e-14);
      squares.push_back(square);
    });
    std::sort(squares.begin(), squares.end());
    const auto wanted = by_hand<Dim>(scene, points, points[i], radius);
    ASSERT_EQ(squares.size(), wanted.size());
    for (std::size_t k = 0; k < squares.size(); ++k) EXPECT_NEAR(squares[k], wanted[k], 1e-12);
  }
}

TEST(PointCells, FindsEveryPointWithinARadius) {
  expect_all_found<2>(scene_of({1.0, 0.7, 0.0}), 400, 0.1, 0.1);
  expect_all_found<2>(scene_of({1.0, 0.7, 0.0}), 400, 0.1, 0.25);
  expect_all_found<2>(scene_of({1.0, 0.7, 0.0}), 400, 0.0, 0.05);
  expect_all_found<3>(scene_of({1.0, 0.7, 1.3}), 400, 0.1, 0.2);
}

TEST(PointCells, FindsImagesWhenTheRadiusExceedsTheBox) {
  expect_all_found<2>(scene_of({1.0, 0.7, 0.0}), 10, 0.3, 1.6);
  expect_all_found<2>(scene_of({1.0, 0.7, 0.0}), 1, 5.0, 1.6);
  expect_all_found<3>(scene_of({1.0, 0.7, 1.3}), 5, 0.3, 1.1);
}

TEST(PointCells, BringsPointsIntoTheBox) {
  const PointCells<2> cells(scene_of({1.0, 2.0, 0.0}), {{2.25, -0.5}, {1.0, -1e-20}}, 0.1);
  const auto inside = cells.wrapped({2.25, -0.5});
  EXPECT_DOUBLE_EQ(inside[0], 0.25);
  EXPECT_DOUBLE_EQ(inside[1], 1.5);
  const auto face = cells.wrapped({1.0, -1e-20});
  EXPECT_EQ(face[0], 0.0);
  EXPECT_EQ(face[1], 0.0);
  int found = 0;
  cells.within({-0.75, 3.5}, 1e-9, [&](Index i, const auto&, double) { found += i == 0 ? 1 : 100; });
  EXPECT_EQ(found, 1);
}

TEST(PointCells, FindsNoImagesBehindWalls) {
  const Scene channel = scene_of({1.0, 0.7, 0.0}, {true, false, true});
  expect_all_found<2>(channel, 400, 0.1, 0.25);
  expect_all_found<2>(channel, 10, 0.3, 1.6);
  // Points a little outside a wall stay where they are and are found there.
  const PointCells<2> cells(channel, {{0.5, -0.01}, {0.5, 0.69}}, 0.1);
  std::vector<Index> found;
  cells.within({0.5, 0.02}, 0.1, [&](Index i, const auto&, double) { found.push_back(i); });
  EXPECT_EQ(found, std::vector<Index>{0});
}

TEST(PointCells, WithoutPointsFindsNothing) {
  const PointCells<2> cells(scene_of({1.0, 2.0, 0.0}), {}, 0.1);
  cells.within({0.5, 0.5}, 3.0, [](Index, const auto&, double) { FAIL(); });
}

}  // namespace
}  // namespace mesogen
