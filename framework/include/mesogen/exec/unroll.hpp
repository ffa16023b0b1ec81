#pragma once

#include <utility>

#include "mesogen/export.hpp"

namespace mesogen::exec {

/// An int that the compiler knows (like std::integral_constant, but also on devices).
template <int Value>
struct Number {
  static constexpr int value = Value;
  MESOGEN_HOST_DEVICE constexpr operator int() const { return Value; }  // NOLINT: meant to be used as the number
};

namespace detail {

template <class Action, int... Numbers>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline void unroll(Action& action, std::integer_sequence<int, Numbers...>) {
  (action(Number<Numbers>{}), ...);
}

}  // namespace detail

/// Calls action(0), action(1), ..., action(Count - 1), written out one by one. In the sums of a pair pass the compiler
/// can then keep an array in registers. It cannot if it unrolls a loop by itself, because it does so later.
template <int Count, class Action>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline void unroll(Action&& action) {
  detail::unroll(action, std::make_integer_sequence<int, Count>{});
}

/// Calls action(d) for the axes 0 to dimension - 1, of which there are at most three: written out too, so that a device
/// keeps what belongs to an axis in registers.
template <class Action>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline void for_axes(int dimension, Action&& action) {
  unroll<3>([&](auto d) {
    if (d < dimension) action(d);
  });
}

}  // namespace mesogen::exec
