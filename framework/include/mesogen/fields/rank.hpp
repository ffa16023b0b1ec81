#pragma once

#include <string_view>

namespace mesogen {

/// What the components of a field mean. Stored components: see component_count().
enum class Rank {
  scalar,        ///< 1
  vector,        ///< Dim
  order_tensor,  ///< symmetric and traceless: 2 in 2D (Q11, Q12), 5 in 3D (Q11, Q12, Q13, Q22, Q23)
  matrix,        ///< Dim x Dim, row by row
};

constexpr int component_count(Rank rank, int dimension) {
  switch (rank) {
    case Rank::scalar: return 1;
    case Rank::vector: return dimension;
    case Rank::order_tensor: return dimension * (dimension + 1) / 2 - 1;
    case Rank::matrix: return dimension * dimension;
  }
  return 0;
}

/// Where an order tensor stores its component Q_ab; -1 of the last of its diagonal, which is minus the sum of the
/// others.
constexpr int order_tensor_place(int a, int b, int dimension) {
  const int row = a < b ? a : b;
  const int column = a < b ? b : a;
  if (row == dimension - 1) return -1;
  int place = 0;
  for (int above = 0; above < row; ++above) place += dimension - above;
  return place + column - row;
}

constexpr std::string_view to_string(Rank rank) {
  switch (rank) {
    case Rank::scalar: return "scalar";
    case Rank::vector: return "vector";
    case Rank::order_tensor: return "order tensor";
    case Rank::matrix: return "matrix";
  }
  return "";
}

/// Arithmetic of the pair passes and stored fields. Integrated quantities always accumulate in double.
enum class Precision { single_precision, double_precision };

/// As in a case: "single", "double".
constexpr std::string_view to_string(Precision precision) {
  return precision == Precision::single_precision ? "single" : "double";
}

}  // namespace mesogen
