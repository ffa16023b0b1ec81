#pragma once

#include "mesogen/fields/rank.hpp"

namespace mesogen {

/// What a field stands for, as far as a boundary must know it.
enum class FieldRole {
  velocity,  ///< of the fluid: the field that Transport::velocity names
  state,     ///< any other field that keeps its value from step to step, such as the order tensor
  derived,   ///< made anew from these: rates, stresses, gradients
};

/// What a field is for a boundary, which knows no field by its name.
struct FieldKind {
  Rank rank = Rank::scalar;
  FieldRole role = FieldRole::derived;
  int dimension = 0;  ///< of space

  [[nodiscard]] constexpr int components() const { return component_count(rank, dimension); }
};

}  // namespace mesogen
