#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The square of the smallest distance, by trying all pairs.
template <int Dim>
double closest_by_hand(const Scene& scene, const std::vector<std::array<double, Dim>>& points) {
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double square = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double along = points[i][d] - points[j][d];
        square += std::pow(scene.periodic[d] ? std::remainder(along, scene.box[d]) : along, 2);
      }
      closest = std::min(closest, square);
    }
  }
  return closest;
}

template <int Dim>
void expect_closest(const Scene& scene, std::size_t count, double width) {
  const auto points = random_points<Dim>(scene.box, count);
  const double wanted = closest_by_hand<Dim>(scene, points);
  ASSERT_LT(wanted, width * width);
  EXPECT_NEAR(PointCells<Dim>(scene, points, width).closest_square(), wanted, 1e-14);
}

TEST(PointCells, FindsTheClosestPair) {
  const std::array<double, 3> box{1.0, 0.7, 1.3};
  for (const std::array<bool, 3>& periodic : {std::array{true, true, true}, std::array{false, false, false},
                                              std::array{true, false, true}, std::array{false, true, false}}) {
    const Scene scene = scene_of(box, periodic);
    for (const std::size_t count : {2, 3, 5, 20, 300}) {
      expect_closest<2>(scene, count, std::sqrt(1.0 / static_cast<double>(count)));
      expect_closest<3>(scene, count, std::cbrt(1.5 / static_cast<double>(count)));
    }
  }
}

// Each pair of neighbouring cells holds the closest pair once, those at the faces too.
TEST(PointCells, FindsTheClosestPairInAnyCells) {
  for (const bool periodic : {true, false}) {
    const Scene scene = scene_of({1.0, 1.0, 1.0}, {periodic, periodic, periodic});
    for (double x = 0.05; x < 1.0; x += 0.1) {
      for (double y = 0.05; y < 1.0; y += 0.1) {
        for (double angle = 0.1; angle < 6.28; angle += 0.7) {
          const std::array other{x + 0.09 * std::cos(angle), y + 0.09 * std::sin(angle)};
          const PointCells<2> cells(scene, {{x, y}, other}, 0.1);
          EXPECT_NEAR(cells.closest_square(), 0.0081, 1e-14) << x << ' ' << y << ' ' << angle;
        }
      }
    }
  }
}

// Of one point alone its own images are not another.
TEST(PointCells, NeedsTwoPointsForAPair) {
  EXPECT_TRUE(std::isinf(PointCells<2>(scene_of({1.0, 2.0, 0.0}), {{0.5, 0.5}}, 0.1).closest_square()));
  EXPECT_TRUE(std::isinf(PointCells<2>(scene_of({1.0, 2.0, 0.0}), {{0.5, 0.5}}, 5.0).closest_square()));
  EXPECT_TRUE(std::isinf(PointCells<2>(scene_of({1.0, 2.0, 0.0}), {}, 5.0).closest_square()));
}

// What is visited, and in which order, is the same with any number of threads.
TEST(PointCells, AreTheSameWithAnyNumberOfThreads) {
  const Scene scene = scene_of({1.0, 0.7, 0.0});
  const auto points = random_points<2>(scene.box, 5000);
  const int before = omp_get_max_threads();
  std::vector<std::vector<Index>> visited;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    const PointCells<2> cells(scene, points, 0.05);
    cells.within({0.1, 0.2}, 0.4,
                 [&, &order = visited.emplace_back()](Index i, const auto&, double) { order.push_back(i); });
  }
  omp_set_num_threads(before);
  EXPECT_GT(visited[0].size(), 100u);
  EXPECT_EQ(visited[1], visited[0]);
  EXPECT_EQ(visited[2], visited[0]);
}

TEST(PointCells, WithoutPointsFindsNothing) {
  const PointCells<2> cells(scene_of({1.0, 2.0, 0.0}), {}, 0.1);
  cells.within({0.5, 0.5}, 3.0, [](Index, const auto&, double) { FAIL(); });
}

}  // namespace
}  // namespace mesogen
