#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/sum_across.hpp"
#include "mesogen/sph/small_matrix.hpp"

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
    const auto sums = this->numbers(add_where_less(this->lane(x), limit, this->lane(given), this->lane(x)));
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      EXPECT_EQ(chosen[n], where_less(x[n], static_cast<Real>(below), given[n])) << n << " of " << below;
      EXPECT_EQ(sums[n], add_where_less(x[n], static_cast<Real>(below), given[n], x[n])) << n << " of " << below;
      EXPECT_EQ(sums[n], x[n] + chosen[n]) << n << " of " << below;
    }
  }
}

// What the search for blocks asks of masks.
TYPED_TEST(Lanes, FirstAndLastOfAMask) {
  using Real = TypeParam;
  const auto x = this->lane(this->row(Real(0), Real(1)));
  EXPECT_TRUE(stdx::none_of(x < Real(0)));
  for (int first = 0; first < this->width; ++first) {
    for (int last = first; last < this->width; ++last) {
      const auto between = x >= static_cast<Real>(first) && x <= static_cast<Real>(last);
      EXPECT_FALSE(stdx::none_of(between));
      EXPECT_EQ(stdx::find_first_set(between), first);
      EXPECT_EQ(stdx::find_last_set(between), last);
    }
  }
}

TYPED_TEST(Lanes, TakesLanesFromASplitOnFromElsewhere) {
  using Real = TypeParam;
  const auto first = this->row(Real(0), Real(1));
  const auto second = this->row(Real(100), Real(1));
  for (int split = 0; split <= this->width; ++split) {
    typename TestFixture::Lane both;
    load(first.data(), second.data(), split, both);
    auto changed = this->lane(first);
    subtract_from(split, this->lane(second), this->lane(first), changed);
    for (int n = 0; n < this->width; ++n) {
      const auto at = static_cast<std::size_t>(n);
      EXPECT_EQ(this->numbers(both)[at], (n < split ? first : second)[at]) << n << " of " << split;
      EXPECT_EQ(this->numbers(changed)[at], n < split ? first[at] : Real(100)) << n << " of " << split;
    }
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

TYPED_TEST(Lanes, RootsAreRight) {
  using Real = TypeParam;
  for (const Real size : {Real(1e-12), Real(0.3), Real(7e8)}) {
    const auto x = this->row(size, size / Real(3));
    typename TestFixture::Lane root;
    typename TestFixture::Lane inverse;
    find_roots(this->lane(x), root, inverse);
    const auto roots = this->numbers(root);
    const auto inverses = this->numbers(inverse);
    for (std::size_t n = 0; n < x.size(); ++n) {
      Real of_number;
      Real inverse_of_number;
      find_roots(x[n], of_number, inverse_of_number);
      EXPECT_NEAR(of_number / std::sqrt(x[n]), Real(1), 4 * std::numeric_limits<Real>::epsilon()) << x[n];
      EXPECT_EQ(of_number, x[n] * inverse_of_number);
      EXPECT_NEAR(roots[n] / std::sqrt(x[n]), Real(1), 4 * std::numeric_limits<Real>::epsilon()) << x[n];
      EXPECT_NEAR(inverses[n] * std::sqrt(x[n]), Real(1), 4 * std::numeric_limits<Real>::epsilon()) << x[n];
    }
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

TYPED_TEST(Lanes, SumsAcrossPacksKeepTheirOrder) {
  using Real = TypeParam;
  constexpr int count = TestFixture::width;
  Real packs[count][count];
  for (int k = 0; k < count; ++k)
    for (int lane = 0; lane < count; ++lane)
      packs[k][lane] = static_cast<Real>(1000 * k + lane * lane);  // whole numbers: any order of additions is exact
  typename TestFixture::Lane sums;
  sum_across(packs, sums);
  const auto found = this->numbers(sums);
  for (int k = 0; k < count; ++k)
    EXPECT_EQ(found[static_cast<std::size_t>(k)], std::accumulate(packs[k], packs[k] + count, Real(0))) << k;

  const Real alone[1][1] = {{Real(0.25)}};
  Real only = 0;
  sum_across(alone, only);
  EXPECT_EQ(only, Real(0.25));
}

TYPED_TEST(Lanes, InvertSymmetricMatrices) {
  using Real = TypeParam;
  // The first matrix of two dimensions is singular: the identity is its inverse.
  const auto first = this->row(Real(0), Real(0.5));
  const typename TestFixture::Lane upper[6] = {this->lane(first), Real(0.25),  Real(-0.5),
                                               Real(2),           Real(0.125), Real(3)};
  typename TestFixture::Lane small[4];
  typename TestFixture::Lane large[9];
  sph::invert_symmetric<Real, 3>(upper, large);
  const typename TestFixture::Lane second[3] = {this->lane(first), Real(0), Real(2)};
  sph::invert_symmetric<Real, 2>(second, small);
  for (std::size_t n = 0; n < first.size(); ++n) {
    const Real a = first[n];
    Real found[9];
    for (int c = 0; c < 9; ++c) found[c] = this->numbers(large[c])[n];
    const Real matrix[9] = {a, Real(0.25), Real(-0.5), Real(0.25), Real(2), Real(0.125), Real(-0.5), Real(0.125), 3};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        Real product(0);
        for (int k = 0; k < 3; ++k) product += matrix[3 * r + k] * found[3 * k + c];
        EXPECT_NEAR(product, r == c ? Real(1) : Real(0), 50 * std::numeric_limits<Real>::epsilon()) << a << r << c;
      }
    }
    EXPECT_EQ(this->numbers(small[0])[n], a == Real(0) ? Real(1) : Real(1) / a);
    EXPECT_EQ(this->numbers(small[3])[n], a == Real(0) ? Real(1) : Real(0.5));
    EXPECT_EQ(this->numbers(small[1])[n], Real(0));
    Real one[4];
    const Real alone[3] = {a, Real(0), Real(2)};
    sph::invert_symmetric<Real, 2>(alone, one);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(this->numbers(small[c])[n], one[c]);
  }
}

}  // namespace
}  // namespace mesogen::exec
