#pragma once

#include <stdexcept>

/// Numbers of components and of dimensions that the compiler knows.
namespace mesogen::exec {

/// Calls action<n>(), compiled for each of the numbers that n may be: a loop with a number of components that the
/// compiler knows handles several particles at a time. Throws std::logic_error if n is none of them.
template <int First, int... Others, class Action>
auto compiled_for(int n, const Action& action) {
  if (n == First) return action.template operator()<First>();
  if constexpr (sizeof...(Others) > 0) return compiled_for<Others...>(n, action);
  throw std::logic_error("a number of components or dimensions that no field has");
}
template <class Action>
auto for_components(int n, const Action& action) {
  return compiled_for<1, 2, 3, 4, 5, 9>(n, action);
}

}  // namespace mesogen::exec
