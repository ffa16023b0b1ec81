// The density filter against Shepard's sum written out, on particles that stay where they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_run.hpp"
#include "written_out.hpp"

namespace {

using namespace mesogen::test;

constexpr double length = 1.0;
constexpr int across = 16;
constexpr double smoothing_length = 2.0 * length / across;
constexpr double beta = 0.7;

TEST(DensityFilter, IsShepards) {
  CaseText text(length, across);
  text.section("kernel", "type = \"wendland_c2\"\nsmoothing_length = 2.0")
      .modes("velocity", "[[1, 2, 0.05, 0.3], [2, -1, 0.07, 1.0]]")
      .published_flow(0.01, "sound_speed = 10.0\nmotion = \"eulerian\"\ndensity_filter = 0.7");
  CaseRun run(text);
  run.run_steps(20);
  const auto x = run.path(0);
  const auto y = run.path(1);
  const auto before = run.field("compression_midpoint");
  const auto after = run.field("compression_filtered");
  const auto [smallest, largest] = std::minmax_element(before.begin(), before.end());
  ASSERT_GT(*largest - *smallest, 1e-5);
  double changed = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double weights = 0.0;
    double weighted = 0.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double w = wendland_c2_shape(
          std::hypot(nearest_image(x[i] - x[j], length), nearest_image(y[i] - y[j], length)), smoothing_length);
      weights += w;
      weighted += w * before[j];
    }
    const double expected = before[i] + beta * (weighted / weights - before[i]);
    EXPECT_NEAR(after[i], expected, 1e-12 * (*largest - *smallest) + 1e-17) << i;
    changed = std::max(changed, std::abs(after[i] - before[i]));
  }
  EXPECT_GT(changed, 0.01 * (*largest - *smallest));
}

}  // namespace
