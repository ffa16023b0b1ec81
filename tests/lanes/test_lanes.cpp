#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mesogen/exec/lanes.hpp"

// The operations on packs, lane by lane against those on numbers: they must not depend on compiler or instruction set.
namespace mesogen::exec {
namespace {

template <class Real>
class Lanes : public ::testing::Test {
 protected:
  using Lane = Pack<Real>;
  static constexpr int width = static_cast<int>(Lane::size());

  static Lane lane(const std::vector<Real>& numbers) {
    Lane result;
    result.copy_from(numbers.data(), stdx::element_aligned);
    return result;
  }
  static std::vector<Real> numbers(const Lane& lane) {
    std::vector<Real> result(width);
    lane.copy_to(result.data(), stdx::element_aligned);
    return result;
  }
  /// first, first + step, ...
  static std::vector<Real> row(Real first, Real step) {
    std::vector<Real> result(width);
    for (int n = 0; n < width; ++n) result[static_cast<std::size_t>(n)] = first + step * static_cast<Real>(n);
    return result;
  }
};

using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Lanes, Reals);

TYPED_TEST(Lanes, WhereLessTakesTheLanesBelowTheLimit) {
  using Real = TypeParam;
  const auto given = this->row(Real(100), Real(1));
  const auto x = this->row(Real(0), Real(1));
  for (int below = 0; below <= this->width; ++below) {
    const typename TestFixture::Lane limit(static_cast<Real>(below));
    const auto chosen = this->numbers(where_less(this->lane(x), limit, this->lane(given)));
    for (std::size_t n = 0; n < chosen.size(); ++n)
      EXPECT_EQ(chosen[n], where_less(x[n], static_cast<Real>(below), given[n])) << n << " of " << below;
  }
}

TYPED_TEST(Lanes, PositivePartAndSquareRoot) {
  using Real = TypeParam;
  const auto x = this->row(Real(-1.5), Real(0.75));
  const auto positive = this->numbers(positive_part(this->lane(x)));
  const auto roots = this->numbers(square_root(positive_part(this->lane(x))));
  for (std::size_t n = 0; n < x.size(); ++n) {
    EXPECT_EQ(positive[n], positive_part(x[n]));
    EXPECT_EQ(roots[n], std::sqrt(positive[n]));
  }
}

TYPED_TEST(Lanes, InverseSquareRootIsRight) {
  using Real = TypeParam;
  for (const Real size : {Real(1e-12), Real(0.3), Real(7e8)}) {
    const auto x = this->row(size, size / Real(3));
    const auto found = this->numbers(inverse_square_root(this->lane(x)));
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_NEAR(found[n] * std::sqrt(x[n]), Real(1), 4 * std::numeric_limits<Real>::epsilon()) << x[n];
  }
}

TYPED_TEST(Lanes, SumsAddAllLanes) {
  using Real = TypeParam;
  constexpr int count = 7;  // no multiple of what is added at a time
  typename TestFixture::Lane packs[count];
  for (int n = 0; n < count; ++n) packs[n] = this->lane(this->row(static_cast<Real>(n), Real(1)));
  Real total[count] = {};
  sum_lanes(packs, total);
  for (int n = 0; n < count; ++n) {
    const auto row = this->row(static_cast<Real>(n), Real(1));
    EXPECT_EQ(total[n], std::accumulate(row.begin(), row.end(), Real(0))) << n;
  }
}

}  // namespace
}  // namespace mesogen::exec
