#include <gtest/gtest.h>

#include "fake_pass_context.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

// f = -zeta (dQ11/dx + dQ12/dy, dQ12/dx - dQ11/dy) / rho, beside what others added
TEST(ActiveStress, AddsTheDivergenceOfItsStress) {
  for (const double zeta : {0.5, -0.5}) {
    const PhysicsUnderTest active("active_stress", {{"activity", zeta}});
    FakePassContext context(2);
    context.set("order_tensor_gradient", {1.0, 20.0, 300.0, 4000.0});  // Q11_x, Q11_y, Q12_x, Q12_y
    context.set("density", {2.0});
    context.set("acceleration", {7.0, 8.0});
    active.run("active stress", context);
    for (const Index i : {0, 1}) {
      EXPECT_DOUBLE_EQ(context.at("acceleration", 0, i), 7.0 - zeta * (1.0 + 4000.0) / 2.0);
      EXPECT_DOUBLE_EQ(context.at("acceleration", 1, i), 8.0 - zeta * (300.0 - 20.0) / 2.0);
    }
  }
}

TEST(ActiveStress, SaysHowLargeItsStressIs) {
  PhysicsUnderTest active("active_stress", {{"activity", -0.3}});
  Scales scales;
  scales.stress = 0.1;
  active->scales(scales);
  EXPECT_EQ(scales.stress, 0.3);
  scales.stress = 1.0;
  active->scales(scales);
  EXPECT_EQ(scales.stress, 1.0) << "another's is larger";
  Constants constants;
  active->constants(constants);
  EXPECT_EQ(constants.at("activity"), -0.3);
}

}  // namespace
