#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

const std::string fluid = "density = 2.0\nviscosity = 0.1\n";

std::string refusal(const std::string& plugin, const std::string& keys) {
  try {
    (void)PluginHarness(PluginKind::physics, plugin, fluid + keys).scene();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(WcsphPublished, NeedsAFilterToFeedBack) {
  const std::string text = refusal("wcsph_published", "density_filter = 0.0\nfilter_feedback = true");
  EXPECT_NE(text.find("filter_feedback: needs a filter: set density_filter above 0, such as density_filter = 1.0"),
            std::string::npos)
      << text;
  EXPECT_EQ(refusal("wcsph_published", "filter_feedback = true"), "");
}

// A case from before, when wcsph had these keys.
TEST(WcsphPublished, IsNamedWhereItsKeysAreGivenToWcsph) {
  for (const std::string key : {"density_filter = 1.0", "filter_feedback = true",
                                "viscosity_form = \"monaghan_gingold\"", "shift_speed = \"spread\""}) {
    const std::string text = refusal("wcsph", key);
    EXPECT_NE(
        text.find(key.substr(0, key.find(' ')) + ": belongs to the published scheme: write type = \"wcsph_published\""),
        std::string::npos)
        << text;
  }
}

// The radial form takes up to 3.3 times as much from the shortest waves.
TEST(WcsphPublished, TakesShorterViscousSteps) {
  const auto step = [](const std::string& keys) {
    return PluginHarness(PluginKind::physics, "wcsph_published", fluid + keys)
        .step_limits()
        .at("viscosity: stable diffusion by mu / rho");
  };
  EXPECT_DOUBLE_EQ(step(""), 0.25 * step("viscosity_form = \"component\""));
}

// In all keys like wcsph it gives the same rates, to rounding: wcsph sums them in one loop.
TEST(WcsphPublished, IsWcsphButForItsSwitches) {
  PluginHarness other(
      PluginKind::physics, "wcsph_published",
      fluid +
          "viscosity_form = \"component\"\ndensity_filter = 0.0\nshift_speed = \"strain\"\nshift = 0.3\n"
          "density_diffusion = 0.1");
  PluginHarness wcsph(PluginKind::physics, "wcsph", fluid);
  for (PluginHarness* const run : {&other, &wcsph}) run->start();
  for (const char* const field : {"acceleration", "shift_velocity", "compression_rate"})
    for (int c = 0; c < wcsph.components(field); ++c) {
      const auto first = other.values(field, c);
      const auto second = wcsph.values(field, c);
      for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_NEAR(first[i], second[i], 1e-12 * (1.0 + std::abs(second[i]))) << field;
    }
}

}  // namespace
