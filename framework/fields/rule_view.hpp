#pragma once

#include <cstddef>

#include "mesogen/fields/affine_rule.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// Affine rules of one field, for images or for wall particles, as loops see them. Trivially copyable.
struct RuleView {
  int components = 0;
  bool diagonal = true;             ///< each component goes by itself
  const double* numbers = nullptr;  ///< null: all values stay the same

  [[nodiscard]] MESOGEN_HOST_DEVICE explicit operator bool() const { return numbers != nullptr; }
  /// Numbers per rule: matrix (its diagonal alone, if that is all), then summand.
  [[nodiscard]] static constexpr MESOGEN_HOST_DEVICE int size(int components, bool diagonal) {
    return components * (diagonal ? 2 : components + 1);
  }

  /// value = A value + b by the n-th rule. `count`: the number of components, an int, or exec::Number where the
  /// compiler knows it: a device then keeps the values in registers.
  template <class Count>
  MESOGEN_HOST_DEVICE void apply(Index n, double* value, Count count) const {
    if (numbers == nullptr) return;
    const double* const rule = numbers + static_cast<std::ptrdiff_t>(n) * size(count, diagonal);
    if (diagonal) {
      for (int c = 0; c < count; ++c) value[c] = rule[c] * value[c] + rule[count + c];
      return;
    }
    double result[AffineRule::most];
    for (int r = 0; r < count; ++r) {
      result[r] = rule[count * count + r];
      for (int c = 0; c < count; ++c) result[r] += rule[r * count + c] * value[c];
    }
    for (int c = 0; c < count; ++c) value[c] = result[c];
  }
};

}  // namespace mesogen
