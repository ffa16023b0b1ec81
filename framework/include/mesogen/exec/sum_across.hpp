#pragma once

#include <utility>

#include "mesogen/exec/lanes.hpp"

/// Sums over the lanes of several packs: as many packs as a pack has lanes.
namespace mesogen::exec {

#ifndef __CUDACC__

namespace detail {

/// Which lanes of two packs are added: for lane n of the result, the first of two lanes; the second is a fixed number
/// of lanes behind it in the same pack. Lanes of the second pack count from Width. At most two instructions per pack.
template <int Width, int InQuarter>  // InQuarter: lanes in 128 bits
struct Pairing {
  /// Within 128 bits: alternately `Unit` lanes of the first pack and `Unit` lanes of the second.
  template <int Unit>
  static constexpr int within(int n) {
    const int at = n % InQuarter;
    return n - at + at / Unit % 2 * Width + at / (2 * Unit) * Unit + at % Unit;
  }
  /// The lower half of each pack.
  static constexpr int halves(int n) { return n < Width / 2 ? n : n + Width / 2; }
  /// The first and third quarter of each pack.
  static constexpr int quarters(int n) {
    const int quarter = n / InQuarter;
    return quarter / 2 * Width + quarter % 2 * 2 * InQuarter + n % InQuarter;
  }
};

template <int (*First)(int), int Apart, class Vector, int... n>
[[gnu::always_inline]] inline Vector add_lanes(const Vector& a, const Vector& b, std::integer_sequence<int, n...>) {
  return __builtin_shufflevector(a, b, First(n)...) + __builtin_shufflevector(a, b, (First(n) + Apart)...);
}

/// Partial sums of `Count` packs, in the order of the packs within 128 bits or more. If Count is the width, each lane
/// of the result holds the whole sum of its pack.
template <int Count, class Vector, class Real>
[[gnu::always_inline]] inline Vector sum_across(const Real* packs) {
  constexpr int width = sizeof(Vector) / sizeof(Real);
  constexpr int in_quarter = 16 / sizeof(Real);
  if constexpr (Count == 1) {
    Vector only;
    __builtin_memcpy(&only, packs, sizeof(only));
    return only;
  } else {
    using Lanes = Pairing<width, in_quarter>;
    constexpr std::make_integer_sequence<int, width> all{};
    const Vector a = sum_across<Count / 2, Vector>(packs);
    const Vector b = sum_across<Count / 2, Vector>(packs + Count / 2 * width);
    if constexpr (Count <= in_quarter) {
      return add_lanes<Lanes::template within<Count / 2>, in_quarter / 2>(a, b, all);
    } else if constexpr (Count == 4 * in_quarter) {
      return add_lanes<Lanes::quarters, in_quarter>(a, b, all);
    } else {
      return add_lanes<Lanes::halves, width / 2>(a, b, all);
    }
  }
}

}  // namespace detail

/// Lane n of `result` is the sum over the lanes of packs[n]; the order of the additions is fixed. This needs half as
/// many instructions as one sum per pack, and the result is again a pack.
template <class Real, class Abi, int Width>
[[gnu::always_inline]] inline void sum_across(const Real (&packs)[Width][Width], stdx::simd<Real, Abi>& result) {
  static_assert(sizeof(result) == Width * sizeof(Real) && Width * sizeof(Real) >= 16 && Width * sizeof(Real) <= 64);
  using Vector [[gnu::vector_size(sizeof(result))]] = Real;
  const Vector sum = detail::sum_across<Width, Vector>(&packs[0][0]);
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
