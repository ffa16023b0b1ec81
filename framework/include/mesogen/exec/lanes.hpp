#pragma once

#include <cmath>
#include <type_traits>

#include "mesogen/exec/unroll.hpp"
#include "mesogen/export.hpp"

#ifndef __CUDACC__
#include <immintrin.h>

#include <experimental/simd>
#endif

/// The lane type of a pair pass. It says how many neighbours one instruction handles.
///
/// A pass is written once, for any lane type. On the CPU the lane type is a SIMD pack of the width for which this
/// library is compiled. On a device, and wherever a scalar is asked for, it is the number itself. The functions here
/// are the few operations beside + - * / that a pass needs.
namespace mesogen::exec {

#ifndef __CUDACC__

namespace stdx = std::experimental;

template <class Real>
using Pack = stdx::native_simd<Real>;

template <class Real, class Abi>
[[gnu::always_inline]] inline void load(const Real* from, stdx::simd<Real, Abi>& lanes) {
  lanes.copy_from(from, stdx::element_aligned);
}
/// The first lanes from `first`, those from number `split` on from `second`. Where the processor has mask registers,
/// one load each.
template <class Real, class Abi>
[[gnu::always_inline]] inline void load(const Real* first, const Real* second, int split,
                                        stdx::simd<Real, Abi>& lanes) {
  using Lane = stdx::simd<Real, Abi>;
#ifdef __AVX512F__
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 4) {
    lanes = Lane(_mm512_mask_loadu_ps(_mm512_loadu_ps(first), static_cast<__mmask16>(0xFFFFU << split), second));
    return;
  }
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 8) {
    lanes = Lane(_mm512_mask_loadu_pd(_mm512_loadu_pd(first), static_cast<__mmask8>(0xFFU << split), second));
    return;
  }
#endif
  if (split >= static_cast<int>(Lane::size())) return load(first, lanes);
  lanes = Lane([&](auto n) { return static_cast<int>(n) < split ? first[n] : second[n]; });
}
/// Puts x - y of `second` into lanes from number `split` on.
template <class Real, class Abi>
[[gnu::always_inline]] inline void subtract_from(int split, const stdx::simd<Real, Abi>& x,
                                                 const stdx::simd<Real, Abi>& y, stdx::simd<Real, Abi>& lanes) {
  using Lane = stdx::simd<Real, Abi>;
#ifdef __AVX512F__
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 4) {
    lanes = Lane(_mm512_mask_sub_ps(static_cast<__m512>(lanes), static_cast<__mmask16>(0xFFFFU << split),
                                    static_cast<__m512>(x), static_cast<__m512>(y)));
    return;
  }
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 8) {
    lanes = Lane(_mm512_mask_sub_pd(static_cast<__m512d>(lanes), static_cast<__mmask8>(0xFFU << split),
                                    static_cast<__m512d>(x), static_cast<__m512d>(y)));
    return;
  }
#endif
  if (split >= static_cast<int>(Lane::size())) return;
  const Lane other = x - y;
  lanes = Lane([&](auto n) { return static_cast<int>(n) < split ? Real(lanes[n]) : Real(other[n]); });
}
template <class Real, class Abi>
[[gnu::always_inline]] inline void store(const stdx::simd<Real, Abi>& lanes, Real* to) {
  lanes.copy_to(to, stdx::element_aligned);
}
/// Returns the same lanes, but hides from the compiler where they come from. Otherwise, if all lanes hold the same
/// number, the compiler takes the number out of the pack and fills the pack again in every turn of a loop.
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> in_register(const stdx::simd<Real, Abi>& lanes) {
  using Vector [[gnu::vector_size(sizeof(lanes))]] = Real;
  Vector vector;
  __builtin_memcpy(&vector, &lanes, sizeof(lanes));
  asm("" : "+v"(vector));
  Real numbers[sizeof(lanes) / sizeof(Real)];
  __builtin_memcpy(numbers, &vector, sizeof(lanes));
  return stdx::simd<Real, Abi>(numbers, stdx::element_aligned);
}
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> positive_part(const stdx::simd<Real, Abi>& x) {
  return stdx::max(x, stdx::simd<Real, Abi>(Real(0)));
}
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> square_root(const stdx::simd<Real, Abi>& x) {
  return stdx::sqrt(x);
}
/// Returns `given` in the lanes where x < limit, and zero in the others.
///
/// Uses intrinsics where the processor has mask registers (AVX-512): compiled by clang, an assignment through such a
/// mask does nothing with libstdc++ 12.
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> where_less(const stdx::simd<Real, Abi>& x,
                                                               const stdx::simd<Real, Abi>& limit,
                                                               const stdx::simd<Real, Abi>& given) {
  using Lane = stdx::simd<Real, Abi>;
#ifdef __AVX512F__
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 4) {
    const __mmask16 less = _mm512_cmp_ps_mask(static_cast<__m512>(x), static_cast<__m512>(limit), _CMP_LT_OQ);
    return Lane(_mm512_maskz_mov_ps(less, static_cast<__m512>(given)));
  }
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 8) {
    const __mmask8 less = _mm512_cmp_pd_mask(static_cast<__m512d>(x), static_cast<__m512d>(limit), _CMP_LT_OQ);
    return Lane(_mm512_maskz_mov_pd(less, static_cast<__m512d>(given)));
  }
#endif
  Lane result(Real(0));
  stdx::where(x < limit, result) = given;
  return result;
}

/// Returns sum + given in the lanes where x < limit, and sum in the others.
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> add_where_less(const stdx::simd<Real, Abi>& x,
                                                                   const stdx::simd<Real, Abi>& limit,
                                                                   const stdx::simd<Real, Abi>& given,
                                                                   const stdx::simd<Real, Abi>& sum) {
#ifdef __AVX512F__
  using Lane = stdx::simd<Real, Abi>;
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 4) {
    const __mmask16 less = _mm512_cmp_ps_mask(static_cast<__m512>(x), static_cast<__m512>(limit), _CMP_LT_OQ);
    return Lane(
        _mm512_mask_add_ps(static_cast<__m512>(sum), less, static_cast<__m512>(sum), static_cast<__m512>(given)));
  }
  if constexpr (sizeof(Lane) == 64 && sizeof(Real) == 8) {
    const __mmask8 less = _mm512_cmp_pd_mask(static_cast<__m512d>(x), static_cast<__m512d>(limit), _CMP_LT_OQ);
    return Lane(
        _mm512_mask_add_pd(static_cast<__m512d>(sum), less, static_cast<__m512d>(sum), static_cast<__m512d>(given)));
  }
#endif
  return sum + where_less(x, limit, given);
}

/// Sets root = sqrt(x) and inverse = 1 / sqrt(x), both to the rounding of Real. Uses the hardware's estimate and
/// Newton's iteration where these are faster than a square root and a division.
template <class Real, class Abi>
[[gnu::always_inline]] inline void find_roots(const stdx::simd<Real, Abi>& x, stdx::simd<Real, Abi>& root,
                                              stdx::simd<Real, Abi>& inverse) {
  using Lane [[maybe_unused]] = stdx::simd<Real, Abi>;
  // y (1 + r) and x y (1 + r), r = (1 - x y^2) / 2
  [[maybe_unused]] const auto improve = [&](const Lane& y) __attribute__((always_inline)) {
    const Lane first = x * y;
    const Lane rest = Real(0.5) - first * (y * Real(0.5));
    root = first + first * rest;
    inverse = y + y * rest;
  };
#ifdef __AVX512F__
  if constexpr (sizeof(Lane) == 64) {
    if constexpr (sizeof(Real) == 4) return improve(Lane(_mm512_rsqrt14_ps(static_cast<__m512>(x))));
    if constexpr (sizeof(Real) == 8) {
      const Lane y(_mm512_rsqrt14_pd(static_cast<__m512d>(x)));
      return improve(y * (x * Real(-0.5) * y * y + Real(1.5)));
    }
  }
#endif
#ifdef __AVX__
  if constexpr (sizeof(Lane) == 32 && sizeof(Real) == 4) return improve(Lane(_mm256_rsqrt_ps(static_cast<__m256>(x))));
#endif
  inverse = Real(1) / stdx::sqrt(x);
  root = x * inverse;
}

/// sqrt(x) where its inverse is not needed. The unit that finds roots works beside those that multiply and add, but for
/// a pack of double numbers it takes longer than they do.
template <class Real, class Abi>
[[gnu::always_inline]] inline stdx::simd<Real, Abi> find_root(const stdx::simd<Real, Abi>& x) {
  if constexpr (sizeof(Real) == 4) return stdx::sqrt(x);
  stdx::simd<Real, Abi> root;
  stdx::simd<Real, Abi> inverse;
  find_roots(x, root, inverse);
  return root;
}

/// total[n] = sum over the lanes of packs[n]; the order of the additions is fixed.
template <int Count, class Lane, class Real>
[[gnu::always_inline]] inline void sum_lanes(const Lane (&packs)[Count], Real* total) {
#ifdef __AVX__
  if constexpr (sizeof(Lane) >= 32 && sizeof(Real) == 4) {
    const auto quarter = [&](auto n) __attribute__((always_inline)) {
      if constexpr (n >= Count) {
        return _mm_setzero_ps();
      } else {
        __m256 y;
#ifdef __AVX512F__
        if constexpr (sizeof(Lane) == 64) {
          const auto z = static_cast<__m512>(packs[n]);
          y = _mm256_add_ps(_mm512_castps512_ps256(z), _mm512_extractf32x8_ps(z, 1));
        } else
#endif
          y = static_cast<__m256>(packs[n]);
        return _mm_add_ps(_mm256_castps256_ps128(y), _mm256_extractf128_ps(y, 1));
      }
    };
    unroll<(Count + 3) / 4>([&](auto group) __attribute__((always_inline)) {
      const auto at = [&](auto n) { return quarter(Number<4 * group + n>{}); };
      const __m128 first = _mm_hadd_ps(at(Number<0>{}), at(Number<1>{}));
      const __m128 second = _mm_hadd_ps(at(Number<2>{}), at(Number<3>{}));
      alignas(16) float out[4];
      _mm_store_ps(out, _mm_hadd_ps(first, second));
      for (int m = 0; m < 4 && 4 * group + m < Count; ++m) total[4 * group + m] = out[m];
    });
    return;
  }
#endif
  unroll<Count>([&](auto n) { total[n] = stdx::reduce(packs[n]); });
}

#endif

/// The same functions for lanes that are plain numbers.
MESOGEN_HOST_DEVICE inline void load(const float* from, float& lane) { lane = *from; }
MESOGEN_HOST_DEVICE inline void load(const double* from, double& lane) { lane = *from; }
MESOGEN_HOST_DEVICE inline void store(float lane, float* to) { *to = lane; }
MESOGEN_HOST_DEVICE inline void store(double lane, double* to) { *to = lane; }
template <int Count, class Real>
MESOGEN_HOST_DEVICE inline void sum_lanes(const Real (&lanes)[Count],
                                          Real* total) requires std::is_floating_point_v<Real> {
  for (int n = 0; n < Count; ++n) total[n] = lanes[n];
}

MESOGEN_HOST_DEVICE inline float positive_part(float x) { return x > 0.0F ? x : 0.0F; }
MESOGEN_HOST_DEVICE inline double positive_part(double x) { return x > 0.0 ? x : 0.0; }
MESOGEN_HOST_DEVICE inline float square_root(float x) { return ::sqrtf(x); }
MESOGEN_HOST_DEVICE inline double square_root(double x) { return ::sqrt(x); }
// A device has an instruction for the inverse root, right to two units in the last place; a root and a division take
// nine times as many.
MESOGEN_HOST_DEVICE inline void find_roots(float x, float& root, float& inverse) {
#ifdef __CUDA_ARCH__
  inverse = ::rsqrtf(x);
#else
  inverse = 1.0F / ::sqrtf(x);
#endif
  root = x * inverse;
}
MESOGEN_HOST_DEVICE inline void find_roots(double x, double& root, double& inverse) {
#ifdef __CUDA_ARCH__
  inverse = ::rsqrt(x);
#else
  inverse = 1.0 / ::sqrt(x);
#endif
  root = x * inverse;
}
template <class Real>
MESOGEN_HOST_DEVICE inline Real find_root(Real x) requires std::is_floating_point_v<Real> {
  Real root;
  Real inverse;
  find_roots(x, root, inverse);
  return root;
}
MESOGEN_HOST_DEVICE inline float where_less(float x, float limit, float given) { return x < limit ? given : 0.0F; }
MESOGEN_HOST_DEVICE inline double where_less(double x, double limit, double given) { return x < limit ? given : 0.0; }
MESOGEN_HOST_DEVICE inline float add_where_less(float x, float limit, float given, float sum) {
  return x < limit ? sum + given : sum;
}
MESOGEN_HOST_DEVICE inline double add_where_less(double x, double limit, double given, double sum) {
  return x < limit ? sum + given : sum;
}

}  // namespace mesogen::exec
