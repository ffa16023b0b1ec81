#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(TemplateName, IsTheSpeedOfAUniformFlow) {
  PluginHarness plugin(PluginKind::observer, "template_name");
  plugin.set("velocity", {3.0, -4.0});
  EXPECT_NEAR(plugin.sample().at("mean_speed").at(0), 5.0, 1e-12);
}

// Half of the particles rest.
TEST(TemplateName, IsAMeanOverTheParticles) {
  PluginHarness plugin(PluginKind::observer, "template_name");
  plugin.set("velocity", {[](double x, double) { return x < 0.5 ? 2.0 : 0.0; }, [](double, double) { return 0.0; }});
  EXPECT_NEAR(plugin.sample().at("mean_speed").at(0), 1.0, 1e-12);
}

}  // namespace
