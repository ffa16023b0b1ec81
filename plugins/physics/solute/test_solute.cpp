// The plugin by itself; diffusion and decay against exact results are in tests/accuracy/test_varying.cpp.

#include <gtest/gtest.h>

#include <cmath>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Solute, IsFedAndDecays) {
  PluginHarness solute(PluginKind::physics, "solute", "diffusivity = 0.0\nsource = 0.3\ndecay = 0.5");
  solute.set("solute", {2.0}).set("solute_rate", {0.0});
  solute.run("source of the solute");
  for (const double rate : solute.values("solute_rate")) EXPECT_DOUBLE_EQ(rate, 0.3);
  solute.run("damping of solute");
  for (const double rate : solute.values("solute_rate")) EXPECT_DOUBLE_EQ(rate, 0.3 - 0.5 * 2.0);
}

TEST(Solute, TellsHowMuchOfItThereWillBe) {
  const auto largest = [](const char* keys) {
    return PluginHarness(PluginKind::physics, "solute", keys).scene().constant("solute_largest");
  };
  EXPECT_DOUBLE_EQ(largest("diffusivity = 0.1\nsource = 0.3\ndecay = 0.5"), 0.6);
  EXPECT_DOUBLE_EQ(largest("diffusivity = 0.1\nsource = 0.3\nlargest = 2.0"), 2.0);
  EXPECT_TRUE(std::isinf(largest("diffusivity = 0.1\nsource = 0.3")));
  EXPECT_TRUE(std::isinf(largest("diffusivity = 0.1\nsource = 0.3\ndecay = '0.1 + 0.5 * (x > 0.5)'")));
  EXPECT_DOUBLE_EQ(largest("diffusivity = 0.1\nsource = -0.3\ndecay = 0.5"), 0.0);
}

}  // namespace
