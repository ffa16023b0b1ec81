#pragma once

#ifndef __CUDACC__
#include <experimental/simd>
#endif

namespace mesogen::mesh {

#ifndef __CUDACC__

/// Numbers at the four points in a row that a particle uses, as one pack.
using FourPoints = std::experimental::fixed_size_simd<double, 4>;

[[gnu::always_inline]] inline FourPoints load(const double* from) {
  return FourPoints(from, std::experimental::element_aligned);
}
[[gnu::always_inline]] inline void store(const FourPoints& numbers, double* to) {
  numbers.copy_to(to, std::experimental::element_aligned);
}
/// The sum of the four numbers, added in pairs.
[[gnu::always_inline]] inline double sum(const FourPoints& numbers) {
  return (numbers[0] + numbers[1]) + (numbers[2] + numbers[3]);
}

#else

/// The same for nvcc. The mesh is used on the host only.
struct FourPoints {
  double number[4];
  FourPoints(double all = 0.0) : number{all, all, all, all} {}
  FourPoints operator*(const FourPoints& by) const {
    FourPoints result;
    for (int n = 0; n < 4; ++n) result.number[n] = number[n] * by.number[n];
    return result;
  }
  FourPoints operator+(const FourPoints& other) const {
    FourPoints result;
    for (int n = 0; n < 4; ++n) result.number[n] = number[n] + other.number[n];
    return result;
  }
};
inline FourPoints load(const double* from) {
  FourPoints result;
  for (int n = 0; n < 4; ++n) result.number[n] = from[n];
  return result;
}
inline void store(const FourPoints& numbers, double* to) {
  for (int n = 0; n < 4; ++n) to[n] = numbers.number[n];
}
inline double sum(const FourPoints& numbers) {
  return (numbers.number[0] + numbers.number[1]) + (numbers.number[2] + numbers.number[3]);
}

#endif

}  // namespace mesogen::mesh
