#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "assignment.hpp"

namespace mesogen {
namespace {

double gain(const Costs& costs, const std::vector<std::size_t>& column_of, double none) {
  double sum = 0.0;
  for (std::size_t row = 0; row < costs.rows; ++row)
    if (column_of[row] != unassigned) sum += none - costs.at(row, column_of[row]);
  return sum;
}

/// The largest gain of all ways to give each row a column or none.
double largest_gain(const Costs& costs, double none) {
  std::vector<std::size_t> order(costs.rows + costs.columns);  // numbers beyond the columns stand for none
  std::iota(order.begin(), order.end(), 0U);
  double largest = 0.0;
  do {
    std::vector<std::size_t> column_of(costs.rows, unassigned);
    for (std::size_t row = 0; row < costs.rows; ++row)
      if (order[row] < costs.columns) column_of[row] = order[row];
    largest = std::max(largest, gain(costs, column_of, none));
  } while (std::next_permutation(order.begin(), order.end()));
  return largest;
}

TEST(Assignment, IsTheBestOfAll) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> cost(0.0, 2.0);
  for (std::size_t rows = 0; rows <= 4; ++rows) {
    for (std::size_t columns = 0; columns <= 4; ++columns) {
      for (int repeat = 0; repeat < 5; ++repeat) {
        Costs costs{rows, columns, std::vector<double>(rows * columns)};
        for (double& c : costs.cost) c = cost(random);
        const auto column_of = best_assignment(costs, 1.0);
        ASSERT_EQ(column_of.size(), rows);
        EXPECT_NEAR(gain(costs, column_of, 1.0), largest_gain(costs, 1.0), 1e-12);
        for (std::size_t a = 0; a < rows; ++a) {
          for (std::size_t b = 0; b < a; ++b) EXPECT_TRUE(column_of[a] == unassigned || column_of[a] != column_of[b]);
        }
      }
    }
  }
}

TEST(Assignment, OfEqualSumsTakesTheFirst) {
  EXPECT_EQ(best_assignment({2, 2, {0.5, 0.5, 0.5, 0.5}}, 1.0), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(best_assignment({1, 2, {1.0, 1.0}}, 1.0), (std::vector<std::size_t>{unassigned}));
}

}  // namespace
}  // namespace mesogen
