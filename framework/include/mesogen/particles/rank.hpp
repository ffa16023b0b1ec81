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
    case Rank::order_tensor: return dimension == 2 ? 2 : 5;
    case Rank::matrix: return dimension * dimension;
  }
  return 0;
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

}  // namespace mesogen
