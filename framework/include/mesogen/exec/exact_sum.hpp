#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// The sum of numbers in double precision, rounded only where it is read. Terms may therefore be added in any order,
/// and by any number of threads: the sum has the same bits. It holds at most 2^31 terms.
///
/// The sum is a fixed-point number that spans all exponents of a double, in digits of 32 bits (Neal, "Fast exact
/// summation using small and large superaccumulators", arXiv:1505.05571, 2015). Terms that are added together are cut
/// into digits by vector instructions (Demmel & Nguyen, IEEE Trans. Comput. 64, 2060, 2015).
class MESOGEN_EXPORT ExactSum {
 public:
  void add(double term);
  void add(std::span<const double> terms);
  void add(const ExactSum& other);
  /// Within one unit in the last place. As ordinary addition would give if a term was infinite or not a number.
  [[nodiscard]] double value() const;

 private:
  static constexpr std::size_t digits = 70;

  void add_some(std::span<const double> terms);

  std::array<std::int64_t, digits> digit_{};  // each may exceed 32 bits, and have either sign
  double not_finite_ = 0.0;                   // sum of the terms that are not
};

/// Sums of `Count` numbers over all i in [0, count), in parallel. terms(i, numbers) must write the numbers of i, and
/// must not throw.
template <std::size_t Count, class Terms>
std::array<double, Count> exact_sums(Index count, const Terms& terms) {
  constexpr Index together = 256;
  std::array<ExactSum, Count> total;
#pragma omp parallel if (count >= parallel_from)
  {
    std::array<ExactSum, Count> own;
#pragma omp for schedule(static)
    for (Index begin = 0; begin < count; begin += together) {
      const Index end = std::min<Index>(count, begin + together);
      double numbers[Count][together];
      for (Index i = begin; i < end; ++i) {
        double at[Count];
        terms(i, at);
        for (std::size_t n = 0; n < Count; ++n) numbers[n][i - begin] = at[n];
      }
      for (std::size_t n = 0; n < Count; ++n) own[n].add({numbers[n], static_cast<std::size_t>(end - begin)});
    }
#pragma omp critical(mesogen_exact_sums)
    for (std::size_t n = 0; n < Count; ++n) total[n].add(own[n]);
  }
  std::array<double, Count> sums;
  for (std::size_t n = 0; n < Count; ++n) sums[n] = total[n].value();
  return sums;
}

}  // namespace mesogen::exec
