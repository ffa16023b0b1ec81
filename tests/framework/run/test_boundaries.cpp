#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "active_scene.hpp"

namespace {

using namespace mesogen::test;

double largest_difference(const std::string& precision, int steps) {
  CaseRun ghosts(active_scene(precision, "periodic_ghosts"));
  CaseRun wrap(active_scene(precision, "periodic_wrap"));
  ghosts.run_steps(steps);
  wrap.run_steps(steps);
  EXPECT_GT(ghosts.state().neighbourhood.boundary_count(), 0);
  EXPECT_EQ(wrap.state().neighbourhood.boundary_count(), 0);
  EXPECT_EQ(ghosts.time(), wrap.time());
  const auto a = state_of(ghosts);
  const auto b = state_of(wrap);
  double most = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n)
    for (std::size_t i = 0; i < a[n].size(); ++i) most = std::max(most, std::abs(a[n][i] - b[n][i]));
  return most;
}

TEST(Boundaries, GhostsAndWrapAgreeToRounding) {
  EXPECT_LT(largest_difference("double", 60), 1e-12);
  EXPECT_LT(largest_difference("single", 60), 1e-4);
}

}  // namespace
