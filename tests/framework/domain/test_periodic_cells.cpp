#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesogen/domain/periodic_cells.hpp"

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

/// Squares of the distances to all points and images within the radius, by trying all of them.
template <int Dim>
std::vector<double> by_hand(const std::array<double, 3>& box, const std::vector<std::array<double, Dim>>& points,
                            const std::array<double, Dim>& centre, double radius) {
  std::vector<double> squares;
  constexpr int images = 4;
  for (const auto& point : points) {
    for (int c = Dim == 3 ? -images : 0; c <= (Dim == 3 ? images : 0); ++c) {
      for (int b = -images; b <= images; ++b) {
        for (int a = -images; a <= images; ++a) {
          const std::array<int, 3> image{a, b, c};
          double square = 0.0;
          for (std::size_t d = 0; d < Dim; ++d) square += std::pow(point[d] + image[d] * box[d] - centre[d], 2);
          if (square <= radius * radius) squares.push_back(square);
        }
      }
    }
  }
  std::sort(squares.begin(), squares.end());
  return squares;
}

template <int Dim>
void expect_all_found(const std::array<double, 3>& box, std::size_t count, double width, double radius) {
  const auto points = random_points<Dim>(box, count);
  const PeriodicCells<Dim> cells(box, points, width);
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 20); ++i) {
    std::vector<double> squares;
    cells.within(points[i], radius, [&](Index j, const auto& displacement, double square) {
      double length = 0.0;
      for (std::size_t d = 0; d < Dim; ++d) {
        length += displacement[d] * displacement[d];
        const double path = points[i][d] + displacement[d] - points[static_cast<std::size_t>(j)][d];
        EXPECT_NEAR(std::remainder(path, box[d]), 0.0, 1e-12);
      }
      EXPECT_NEAR(length, square, 1e-14);
      squares.push_back(square);
    });
    std::sort(squares.begin(), squares.end());
    const auto wanted = by_hand<Dim>(box, points, points[i], radius);
    ASSERT_EQ(squares.size(), wanted.size());
    for (std::size_t k = 0; k < squares.size(); ++k) EXPECT_NEAR(squares[k], wanted[k], 1e-12);
  }
}

TEST(PeriodicCells, FindsEveryPointWithinARadius) {
  expect_all_found<2>({1.0, 0.7, 0.0}, 400, 0.1, 0.1);
  expect_all_found<2>({1.0, 0.7, 0.0}, 400, 0.1, 0.25);
  expect_all_found<2>({1.0, 0.7, 0.0}, 400, 0.0, 0.05);
  expect_all_found<3>({1.0, 0.7, 1.3}, 400, 0.1, 0.2);
}

TEST(PeriodicCells, FindsImagesWhenTheRadiusExceedsTheBox) {
  expect_all_found<2>({1.0, 0.7, 0.0}, 10, 0.3, 1.6);
  expect_all_found<2>({1.0, 0.7, 0.0}, 1, 5.0, 1.6);
  expect_all_found<3>({1.0, 0.7, 1.3}, 5, 0.3, 1.1);
}

TEST(PeriodicCells, BringsPointsIntoTheBox) {
  const PeriodicCells<2> cells({1.0, 2.0, 0.0}, {{2.25, -0.5}, {1.0, -1e-20}}, 0.1);
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

TEST(PeriodicCells, WithoutPointsFindsNothing) {
  const PeriodicCells<2> cells({1.0, 2.0, 0.0}, {}, 0.1);
  cells.within({0.5, 0.5}, 3.0, [](Index, const auto&, double) { FAIL(); });
}

}  // namespace
}  // namespace mesogen
