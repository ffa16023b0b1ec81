#pragma once

#include <cstring>
#include <experimental/simd>
#include <utility>

namespace mesogen::mesh {

/// Points per axis that a particle uses.
inline constexpr int points_per_axis = 4;

/// Numbers of `Width` fields at the four points in a row that a particle uses, point by point, as one pack.
template <class Real, int Width>
using FourPoints = std::experimental::fixed_size_simd<Real, points_per_axis * Width>;

template <class Pack, class Real>
[[gnu::always_inline]] inline Pack load(const Real* from) {
  return Pack(from, std::experimental::element_aligned);
}
template <class Pack, class Real>
[[gnu::always_inline]] inline void store(const Pack& numbers, Real* to) {
  numbers.copy_to(to, std::experimental::element_aligned);
}

/// Sets to[n] = numbers[n % Width] for all `n` by a shuffle: a pack that is loaded from many narrow stores has to wait
/// for the last of them.
template <int Width, class Real, int... n>
[[gnu::always_inline]] inline void repeat(const Real* numbers, Real* to, std::integer_sequence<int, n...>) {
  using Vector [[gnu::vector_size(sizeof...(n) * sizeof(Real))]] = Real;
  Vector first{};
  for (int c = 0; c < Width; ++c) first[c] = numbers[c];
  const auto all = __builtin_shufflevector(first, first, (n % Width)...);
  std::memcpy(to, &all, sizeof all);
}

/// The `Width` numbers of one particle, at each of the four points.
template <int Width, class Real>
[[gnu::always_inline]] inline FourPoints<Real, Width> at_each_point(const Real* numbers) {
  if constexpr (Width == 1) {
    return FourPoints<Real, 1>(numbers[0]);
  } else {
    Real all[points_per_axis * Width];
    repeat<Width>(numbers, all, std::make_integer_sequence<int, points_per_axis * Width>());
    return load<FourPoints<Real, Width>>(all);
  }
}

/// Adds up the numbers of each field over the four points, in pairs. Writes `Width` sums.
template <int Width, class Real>
[[gnu::always_inline]] inline void add_points(const FourPoints<Real, Width>& numbers, Real* sums) {
  using Point = std::experimental::fixed_size_simd<Real, Width>;
  Real all[points_per_axis * Width];
  store(numbers, all);
  store((load<Point>(all) + load<Point>(all + Width)) + (load<Point>(all + 2 * Width) + load<Point>(all + 3 * Width)),
        sums);
}

}  // namespace mesogen::mesh
