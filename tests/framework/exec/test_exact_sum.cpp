#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mesogen/exec/exact_sum.hpp"

namespace mesogen::exec {
namespace {

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  sum.add(terms);
  return sum.value();
}

double one_by_one(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Numbers of all magnitudes from 10^-digits to 10^digits, of either sign.
std::vector<double> random_terms(std::size_t count, double digits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-digits, digits);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::vector<double> terms(count);
  for (double& term : terms) term = mantissa(random) * std::pow(10.0, exponent(random));
  return terms;
}

TEST(ExactSum, LosesNothing) {
  EXPECT_EQ(sum_of({}), 0.0);
  EXPECT_EQ(sum_of({1.0, 1e100, 1.0, -1e100}), 2.0);
  EXPECT_EQ(sum_of({1e308, 3e-308, -1e308}), 3e-308);
  EXPECT_EQ(sum_of({0x1p-1074, 0x1p1023, 0x1p-1074, -0x1p1023}), 0x1p-1073);
  EXPECT_EQ(sum_of({-0x1p53, -1.0, -1.0}), -0x1p53 - 2.0);
  EXPECT_EQ(sum_of({1.5, -4.0}), -2.5);
}

// The sum of 0 to n is known.
TEST(ExactSum, AddsManyTerms) {
  constexpr int count = 100'001;
  std::vector<double> terms;
  for (int n = 0; n < count; ++n) terms.push_back(n * 0x1p-40);
  EXPECT_EQ(sum_of(terms), 0x1p-40 * (count - 1.0) * count / 2.0);
}

TEST(ExactSum, EveryTermIsTakenAwayAgain) {
  for (const double digits : {0.0, 3.0, 20.0, 300.0}) {
    auto terms = random_terms(3000, digits);
    std::vector<double> both = terms;
    std::shuffle(terms.begin(), terms.end(), std::mt19937(1));
    for (const double term : terms) both.push_back(-term);
    EXPECT_EQ(sum_of(both), 0.0) << digits;
    EXPECT_EQ(one_by_one(both), 0.0) << digits;
  }
}

TEST(ExactSum, IsTheSameInAnyOrder) {
  for (const double digits : {0.0, 3.0, 20.0, 300.0}) {
    auto terms = random_terms(3000, digits);
    const double sum = sum_of(terms);
    EXPECT_EQ(one_by_one(terms), sum) << digits;
    for (unsigned seed = 0; seed < 5; ++seed) {
      std::shuffle(terms.begin(), terms.end(), std::mt19937(seed));
      EXPECT_EQ(sum_of(terms), sum) << digits;
    }
  }
}

TEST(ExactSum, TellsOfWhatIsNotFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sum_of({1.0, infinity, -3.0}), infinity);
  EXPECT_EQ(sum_of({-infinity, 1e300}), -infinity);
  EXPECT_TRUE(std::isnan(sum_of({infinity, 1.0, -infinity})));
  EXPECT_TRUE(std::isnan(sum_of({1.0, std::nan(""), 2.0})));
}

TEST(ExactSum, IsTheSameWithAnyNumberOfThreads) {
  const auto terms = random_terms(10'000, 20.0);
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    const auto sums = exact_sums<2>(static_cast<Index>(terms.size()), [&](Index i, double(&numbers)[2]) {
      numbers[0] = terms[static_cast<std::size_t>(i)];
      numbers[1] = i;
    });
    EXPECT_EQ(sums[0], sum_of(terms)) << threads;
    EXPECT_EQ(sums[1], 9999.0 * 10'000.0 / 2.0) << threads;
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace mesogen::exec
