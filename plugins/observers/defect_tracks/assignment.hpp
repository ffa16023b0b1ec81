#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace mesogen {

/// Costs of giving each of `rows` one of `columns`, row by row.
struct Costs {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> cost;

  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return cost[row * columns + column]; }
};

inline constexpr std::size_t unassigned = std::numeric_limits<std::size_t>::max();

/// The column of each row, no column twice: that choice of pairs whose sum of `none` - cost is largest, so a pair is
/// made only where it costs less than `none`. The Hungarian method by shortest augmenting paths (Jonker & Volgenant,
/// Computing 38, 325, 1987), at most of order n^3. Among equal sums the choice follows from the order of rows and
/// columns alone.
inline std::vector<std::size_t> best_assignment(const Costs& costs, double none) {
  // The same as a square problem: everybody is paired, and a pair at the price `none` is none.
  const std::size_t size = std::max(costs.rows, costs.columns);
  const auto cost = [&](std::size_t row, std::size_t column) {
    return row < costs.rows && column < costs.columns && costs.at(row, column) < none ? costs.at(row, column) : none;
  };
  std::vector<double> row_price(size, 0.0);  // cost - prices >= 0 everywhere, and 0 where assigned
  std::vector<double> column_price(size, 0.0);
  std::vector<std::size_t> row_of(size, unassigned);
  for (std::size_t start = 0; start < size; ++start) {
    // The shortest path from the new row to a free column, going back along assigned pairs (Dijkstra).
    std::vector<double> length(size, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(size, unassigned);  // the column before, on the way to each
    std::vector<bool> reached(size, false);
    std::vector<std::size_t> order;
    std::size_t row = start;
    std::size_t last = unassigned;
    double so_far = 0.0;
    for (;;) {
      std::size_t nearest = unassigned;
      for (std::size_t column = 0; column < size; ++column) {
        if (reached[column]) continue;
        const double through = so_far + cost(row, column) - row_price[row] - column_price[column];
        if (through < length[column]) {
          length[column] = through;
          from[column] = last;
        }
        if (nearest == unassigned || length[column] < length[nearest]) nearest = column;
      }
      so_far = length[nearest];
      last = nearest;
      if (row_of[nearest] == unassigned) break;
      reached[nearest] = true;
      order.push_back(nearest);
      row = row_of[nearest];
    }
    row_price[start] += so_far;
    for (const std::size_t column : order) {
      row_price[row_of[column]] += so_far - length[column];
      column_price[column] -= so_far - length[column];
    }
    for (std::size_t column = last; column != unassigned; column = from[column])
      row_of[column] = from[column] == unassigned ? start : row_of[from[column]];
  }
  std::vector<std::size_t> column_of(costs.rows, unassigned);
  for (std::size_t column = 0; column < costs.columns; ++column) {
    const std::size_t row = row_of[column];
    if (row < costs.rows && costs.at(row, column) < none) column_of[row] = column;
  }
  return column_of;
}

}  // namespace mesogen
