#include <gtest/gtest.h>

#include "mesogen/exec/compensated_sum.hpp"

namespace mesogen::exec {
namespace {

TEST(CompensatedSum, KeepsWhatOrdinaryAdditionLoses) {
  CompensatedSum sum;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) sum.add(term);
  EXPECT_EQ(sum.value(), 2.0);
}

TEST(CompensatedSum, ErrorDoesNotGrowWithTheNumberOfTerms) {
  CompensatedSum sum;
  double plain = 0.0;
  for (int n = 0; n < 1'000'000; ++n) {
    sum.add(0.1);
    plain += 0.1;
  }
  EXPECT_NEAR(sum.value(), 100'000.0, 1e-10);
  EXPECT_GT(plain - 100'000.0, 1e-7);  // that it is needed
}

}  // namespace
}  // namespace mesogen::exec
