#pragma once

#include <utility>

#include "mesogen/exec/lanes.hpp"

/// Sums over the lanes of several packs: as many packs as a pack has lanes.
namespace mesogen::exec {

#ifndef __CUDACC__

namespace detail {

/// Adds lanes that are `Unit` apart, of the first pack into lanes whose number has no bit `Unit`, of the second into
/// the others. One instruction puts two packs together lane by lane, one exchanges lanes.
template <int Unit, class Vector, int... n>
[[gnu::always_inline]] inline Vector add_lanes(const Vector& a, const Vector& b, std::integer_sequence<int, n...>) {
  constexpr int width = sizeof...(n);
  return __builtin_shufflevector(a, b, ((n & Unit) == 0 ? n : width + n)...) +
         __builtin_shufflevector(a, b, ((n & Unit) == 0 ? n + Unit : width + n - Unit)...);
}

/// The packs whose number has the same bits below `Unit` as `at`: lane n holds the sum over every `Unit`-th lane, from
/// n % Unit on, of the pack whose bits from `Unit` on are those of n.
template <int Unit, class Vector, class Real>
[[gnu::always_inline]] inline Vector sum_across(const Real* packs, int at) {
  constexpr int width = sizeof(Vector) / sizeof(Real);
  if constexpr (Unit == width) {
    Vector only;
    __builtin_memcpy(&only, packs + at * width, sizeof(only));
    return only;
  } else {
    const Vector a = sum_across<2 * Unit, Vector>(packs, at);
    const Vector b = sum_across<2 * Unit, Vector>(packs, at + Unit);
    return add_lanes<Unit>(a, b, std::make_integer_sequence<int, width>());
  }
}

}  // namespace detail

/// Lane n of `result` is the sum over the lanes of packs[n]; the order of the additions is fixed. This needs half as
/// many instructions as one sum per pack, and the result is again a pack.
template <class Real, class Abi, int Width>
[[gnu::always_inline]] inline void sum_across(const Real (&packs)[Width][Width], stdx::simd<Real, Abi>& result) {
  static_assert(sizeof(result) == Width * sizeof(Real) && Width * sizeof(Real) >= 16 && Width * sizeof(Real) <= 64);
  using Vector [[gnu::vector_size(sizeof(result))]] = Real;
  const Vector sum = detail::sum_across<1, Vector>(&packs[0][0], 0);
  Real lanes[Width];
  __builtin_memcpy(lanes, &sum, sizeof(sum));
  load(lanes, result);
}

#endif

/// The same for lanes that are plain numbers.
template <class Real>
MESOGEN_HOST_DEVICE inline void sum_across(const Real (&packs)[1][1], Real& result) {
  result = packs[0][0];
}

}  // namespace mesogen::exec
