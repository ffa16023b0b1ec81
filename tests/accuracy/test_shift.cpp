// The shift of particles against its sum written out, at the start of a run with jittered particles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "case_run.hpp"
#include "written_out.hpp"

namespace {

using namespace mesogen::test;

constexpr double length = 1.0;
constexpr int across = 16;
constexpr double smoothing_length = 2.0 * length / across;
constexpr double strength = 0.8;

CaseRun run_with(const std::string& speed) {
  CaseText text(length, across);
  text.section("particles", "spacing = 0.0625\narrangement = \"jittered\"\njitter = 0.2\nseed = 5")
      .section("kernel", "type = \"wendland_c2\"\nsmoothing_length = 2.0")
      .modes("velocity", "[[1, 2, 0.05, 0.3], [2, -1, 0.07, 1.0]]")
      .published_flow(0.01, "sound_speed = 10.0\nshift = 0.8\nshift_speed = \"" + speed + "\"")
      .read("\"velocity_gradient\"");
  return CaseRun(text);
}

void expect_written_out(const std::string& form) {
  CaseRun run = run_with(form);
  const std::vector<double> place[2] = {run.path(0), run.path(1)};
  const std::vector<double> velocity[2] = {run.field("velocity", 0), run.field("velocity", 1)};
  const std::vector<double> gradient[4] = {run.field("velocity_gradient", 0), run.field("velocity_gradient", 1),
                                           run.field("velocity_gradient", 2), run.field("velocity_gradient", 3)};
  const std::vector<double> found[2] = {run.field("shift_velocity", 0), run.field("shift_velocity", 1)};
  double largest = 0.0;
  for (std::size_t i = 0; i < place[0].size(); ++i) {
    double push[2] = {};
    double spread[2] = {};
    double weights = 0.0;
    double distances = 0.0;
    int others = 0;
    for (std::size_t j = 0; j < place[0].size(); ++j) {
      const double apart[2] = {nearest_image(place[0][i] - place[0][j], length),
                               nearest_image(place[1][i] - place[1][j], length)};
      const double distance = std::hypot(apart[0], apart[1]);
      if (distance >= 2.0 * smoothing_length) continue;
      weights += wendland_c2_shape(distance, smoothing_length);
      for (int d = 0; d < 2; ++d)
        spread[d] += wendland_c2_shape(distance, smoothing_length) * (velocity[d][i] - velocity[d][j]);
      if (i == j) continue;
      ++others;
      distances += distance;
      for (int d = 0; d < 2; ++d) push[d] += apart[d] / std::pow(distance, 3);
    }
    double speed = std::hypot(spread[0], spread[1]) / weights;
    if (form == "strain")
      speed = smoothing_length * std::sqrt(std::pow(gradient[0][i], 2) + std::pow(gradient[1][i], 2) +
                                           std::pow(gradient[2][i], 2) + std::pow(gradient[3][i], 2));
    const double scale = strength * std::pow(distances / others, 2) * speed;
    for (int d = 0; d < 2; ++d) {
      EXPECT_NEAR(found[d][i], scale * push[d], 1e-10) << i;
      largest = std::max(largest, std::abs(found[d][i]));
    }
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(Shift, ByTheRateOfStrainIsTheSumWrittenOut) { expect_written_out("strain"); }

TEST(Shift, BySpreadOfVelocitiesIsThePublishedSum) { expect_written_out("spread"); }

}  // namespace
