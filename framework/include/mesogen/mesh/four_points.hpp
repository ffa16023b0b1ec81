#pragma once

#ifndef __CUDACC__
#include <cstring>
#include <experimental/simd>
#include <utility>
#endif

namespace mesogen::mesh {

/// Points per axis that a particle uses.
inline constexpr int points_per_axis = 4;

#ifndef __CUDACC__

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

#else

/// The same for nvcc. The mesh is used on the host only.
template <class Real, int Width>
struct FourPoints {
  static constexpr int count = points_per_axis * Width;
  Real number[count];
  FourPoints(Real all = Real(0)) {
    for (Real& one : number) one = all;
  }
  FourPoints operator*(const FourPoints& by) const {
    FourPoints result;
    for (int n = 0; n < count; ++n) result.number[n] = number[n] * by.number[n];
    return result;
  }
  FourPoints operator+(const FourPoints& other) const {
    FourPoints result;
    for (int n = 0; n < count; ++n) result.number[n] = number[n] + other.number[n];
    return result;
  }
};
template <class Pack, class Real>
Pack load(const Real* from) {
  Pack result;
  for (int n = 0; n < Pack::count; ++n) result.number[n] = from[n];
  return result;
}
template <class Pack, class Real>
void store(const Pack& numbers, Real* to) {
  for (int n = 0; n < Pack::count; ++n) to[n] = numbers.number[n];
}

#endif

#ifndef __CUDACC__
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
#endif

/// The `Width` numbers of one particle, at each of the four points.
template <int Width, class Real>
[[gnu::always_inline]] inline FourPoints<Real, Width> at_each_point(const Real* numbers) {
#ifndef __CUDACC__
  if constexpr (Width == 1) {
    return FourPoints<Real, 1>(numbers[0]);
  } else {
    Real all[points_per_axis * Width];
    repeat<Width>(numbers, all, std::make_integer_sequence<int, points_per_axis * Width>());
    return load<FourPoints<Real, Width>>(all);
  }
#else
  FourPoints<Real, Width> result;
  for (int n = 0; n < result.count; ++n) result.number[n] = numbers[n % Width];
  return result;
#endif
}

/// Adds up the numbers of each field over the four points, in pairs. Writes `Width` sums.
template <int Width, class Real>
[[gnu::always_inline]] inline void add_points(const FourPoints<Real, Width>& numbers, Real* sums) {
#ifndef __CUDACC__
  using Point = std::experimental::fixed_size_simd<Real, Width>;
  Real all[points_per_axis * Width];
  store(numbers, all);
  store((load<Point>(all) + load<Point>(all + Width)) + (load<Point>(all + 2 * Width) + load<Point>(all + 3 * Width)),
        sums);
#else
  for (int c = 0; c < Width; ++c)
    sums[c] = (numbers.number[c] + numbers.number[Width + c]) +
              (numbers.number[2 * Width + c] + numbers.number[3 * Width + c]);
#endif
}

}  // namespace mesogen::mesh
