// Opposite forces on two particles make no momentum; forces that are exact for linear fields make a little.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

struct Sum {
  double total;
  double magnitude;
};

/// Of the accelerations of jittered particles with a director wave: |sum a_i| and sum |a_i|.
Sum of_accelerations(const std::string& form) {
  CaseText text(10.0, 24);
  text.section("particles", "spacing = 0.4166666666666667\narrangement = \"jittered\"\njitter = 0.2\nseed = 3")
      .modes("director", "[[1, 2, 0.5, 0.3], [2, 0, 0.3, 1.0]]")
      .flow(0.3, "sound_speed = 8.0\npressure_form = \"" + form + "\"")
      .nematic(0.4, 0.7, 0.1)
      .section("physics.active", "type = \"active_stress\"\nactivity = 0.3\nform = \"" + form + "\"");
  CaseRun run(text);
  const auto x = run.field("acceleration", 0);
  const auto y = run.field("acceleration", 1);
  Sum sum{0.0, 0.0};
  double total[2] = {};
  for (std::size_t i = 0; i < x.size(); ++i) {
    total[0] += x[i];
    total[1] += y[i];
    sum.magnitude += std::hypot(x[i], y[i]);
  }
  sum.total = std::hypot(total[0], total[1]);
  return sum;
}

TEST(Momentum, ConservativeFormsMakeNone) {
  const Sum conservative = of_accelerations("conservative");
  EXPECT_GT(conservative.magnitude, 1.0);
  EXPECT_LT(conservative.total, 1e-12 * conservative.magnitude);
}

TEST(Momentum, CorrectedFormsMakeALittle) {
  const Sum corrected = of_accelerations("corrected");
  EXPECT_GT(corrected.total, 1e-6 * corrected.magnitude);
  EXPECT_LT(corrected.total, 0.05 * corrected.magnitude);
}

}  // namespace
