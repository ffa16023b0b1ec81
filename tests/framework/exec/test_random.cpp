#include "mesogen/exec/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mesogen::exec {
namespace {

void expect_words(const Philox& random, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  EXPECT_EQ(random.word[0], a);
  EXPECT_EQ(random.word[1], b);
  EXPECT_EQ(random.word[2], c);
  EXPECT_EQ(random.word[3], d);
}

TEST(Philox, GivesThePublishedNumbers) {
  // known answers of the authors' Random123 library
  expect_words(Philox(0, 0, 0), 0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U);
  const auto ones = ~std::uint64_t{0};
  expect_words(Philox(ones, ones, ones), 0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU);
  expect_words(Philox(0x299f31d0a4093822U, 0x85a308d3243f6a88U, 0x0370734413198a2eU), 0xd16cfe09U, 0x94fdcceb,
               0x5001e420U, 0x24126ea1U);
}

TEST(RandomUniform, DependsOnSeedIdAndStream) {
  const double number = random_uniform(1, 2, 3);
  EXPECT_EQ(random_uniform(1, 2, 3), number);
  EXPECT_NE(random_uniform(2, 2, 3), number);
  EXPECT_NE(random_uniform(1, 3, 3), number);
  EXPECT_NE(random_uniform(1, 2, 4), number);
  EXPECT_NE(random_uniform(-1, 2, 3), number);
}

TEST(RandomUniform, IsUniform) {
  constexpr int count = 100000;
  double sum = 0.0;
  double squares = 0.0;
  double products = 0.0;
  double before = random_uniform(7, -1, 0);
  for (int id = 0; id < count; ++id) {
    const double number = random_uniform(7, id, 0);
    ASSERT_GE(number, 0.0);
    ASSERT_LT(number, 1.0);
    sum += number;
    squares += number * number;
    products += (number - 0.5) * (before - 0.5);
    before = number;
  }
  // four standard deviations of each mean
  const double root = std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(sum / count, 1.0 / 2.0, 4.0 * std::sqrt(1.0 / 12.0) / root);
  EXPECT_NEAR(squares / count, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0) / root);
  EXPECT_NEAR(products / count, 0.0, 4.0 / 12.0 / root);
}

}  // namespace
}  // namespace mesogen::exec
