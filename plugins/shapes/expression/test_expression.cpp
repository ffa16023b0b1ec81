#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

// A disc by a formula that grows with the square of the distance.
TEST(ShapeByExpression, FindsTheDistance) {
  PluginHarness plugin(PluginKind::shape, "expression", "distance = \"((x - 0.5)^2 + (y - 0.4)^2) / 0.09 - 1\"");
  const Shape& disc = plugin.shape();
  const double reach = plugin.scene().support;
  for (int n = 0; n < 40; ++n)
    for (const double off : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
      const double angle = n * 0.157;
      const double radius = 0.3 + off * reach;
      const double found = disc.distance({0.5 + radius * std::cos(angle), 0.4 + radius * std::sin(angle), 0.0});
      EXPECT_NEAR(found, off * reach, 1e-6 * reach) << angle;
    }
  EXPECT_LT(disc.distance({0.5, 0.4, 0.0}), -reach);
}

// The foot of a point on the long axis of an ellipse with half axes a and b, inside near its end, is the end.
TEST(ShapeByExpression, KnowsAnEllipse) {
  PluginHarness plugin(PluginKind::shape, "expression", "distance = \"(x - 0.5)^2 / 0.16 + (y - 0.5)^2 / 0.09 - 1\"");
  EXPECT_NEAR(plugin.shape().distance({0.85, 0.5, 0.0}), -0.05, 1e-7);
  EXPECT_NEAR(plugin.shape().distance({0.5, 0.86, 0.0}), 0.06, 1e-7);
  EXPECT_EQ(plugin.shape().centre()[0], 0.0);
}

TEST(ShapeByExpression, RefusesWhatIsNoFormulaOfPlace) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      (void)PluginHarness(PluginKind::shape, "expression", "distance = \"" + text + "\"").scene();
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_NE(refusal("x - t").find("distance: \"x - t\": \"t\" is the time, on which this must not depend"),
            std::string::npos)
      << refusal("x - t");
  EXPECT_NE(refusal("sqrt(x - 0.5)")
                .find("distance: \"sqrt(x - 0.5)\" must be finite everywhere, but is no number at (0, 0)"),
            std::string::npos)
      << refusal("sqrt(x - 0.5)");
  for (const char* const text : {"0.5 - (x < 0.45)", "((x - 0.5)^2 + (y - 0.5)^2 - 0.09)^3"})
    EXPECT_NE(refusal(text).find("must rise through 0 with a slope, but jumps or is flat at ("), std::string::npos)
        << refusal(text);
  EXPECT_NE(refusal("x - w").find("distance: \"x - w\": \"w\" is not known"), std::string::npos);
}

}  // namespace
