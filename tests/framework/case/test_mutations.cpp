#include <gtest/gtest.h>

#include "case_texts.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mutator.hpp"

namespace mesogen {
namespace {

TEST(MutatedCases, AreReadOrRefused) {
  int accepted = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    const std::string text = test::Mutator(seed).mutated(testing::good_case);
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    Problems problems;
    Case read;
    ASSERT_NO_THROW(read = testing::read_all(text, {}, problems));
    if (!problems.empty()) {
      EXPECT_NE(problems.text().find("case.toml:"), std::string::npos) << problems.text();
      EXPECT_EQ(problems.text().find('\033'), std::string::npos);
      continue;
    }
    ++accepted;
    // what is accepted has all that a run needs, and survives being written and read again
    EXPECT_GT(read.time.end, 0.0);
    EXPECT_GT(read.particles.spacing, 0.0);
    EXPECT_FALSE(read.physics.empty());
    const Case again = testing::read_all(read.resolved_text, {}, problems);
    EXPECT_EQ(problems.text(), "");
    EXPECT_EQ(again.resolved_text, read.resolved_text);
  }
  EXPECT_GT(accepted, 20);
  EXPECT_LT(accepted, 1000);
}

}  // namespace
}  // namespace mesogen
