// What a step finds tells how far particles can be from where they were sorted after half of the next step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// How far the farthest particle is from where it was sorted, m.
double farthest_from_sorted(State& state) {
  double most = 0.0;
  for (std::size_t i = 0; i < state.particles.id.size(); ++i) {
    double square = 0.0;
    for (std::size_t d = 0; d < 2; ++d)
      square += std::pow(state.particles.position[d].host()[i] - state.neighbourhood.sorted_position()[d].host()[i], 2);
    most = std::max(most, square);
  }
  return std::sqrt(most);
}

CaseText shear_with_waves(const std::string& time) {
  CaseText text(2.0, 20);
  return text.modes("velocity", "[[0, 1, 0.4, 0.1], [1, 0, 0.05, 0.3]]")
      .flow(0.02)
      .section("time", "end = 1e6\n" + time);
}

class Straying : public testing::TestWithParam<const char*> {};

// A bound that is too small would leave pairs out, one that is too large would cost a look at every step.
TEST_P(Straying, TheBoundHoldsAndIsTight) {
  CaseRun run(shear_with_waves(GetParam()));
  State& state = run.state();
  const double half_skin = state.neighbourhood.skin() / 2.0;
  const std::int64_t sorted_before = state.neighbourhood.sortings();
  double farthest = 0.0;
  for (int n = 0; n < 120; ++n) {
    run.run_steps(1);
    const Motion& motion = run.stepper().motion();
    ASSERT_NEAR(motion.farthest, farthest_from_sorted(state), 1e-12) << "after step " << n;
    // Midpoints were within half the skin, or particles would have been sorted there.
    ASSERT_LE(motion.farthest, half_skin + 0.51 * state.step_size * motion.fastest) << "after step " << n;
    farthest = std::max(farthest, motion.farthest);
  }
  EXPECT_GT(state.neighbourhood.sortings(), sorted_before + 2);
  EXPECT_GT(farthest, 0.9 * half_skin) << "particles are sorted no earlier than they must be";
}

INSTANTIATE_TEST_SUITE_P(Steps, Straying,
                         testing::Values("stepping = \"explicit\"", "stepping = \"explicit\"\nscheme = \"half_steps\"",
                                         "stepping = \"stabilised\""));

}  // namespace
