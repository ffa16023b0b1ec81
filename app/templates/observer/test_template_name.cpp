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

// The same in a run that is resumed in between: what was gathered goes on.
TEST(TemplateName, RemembersTheHighestInAResumedRun) {
  PluginHarness first(PluginKind::observer, "template_name");
  first.set("velocity", {3.0, -4.0});
  first.sample();
  PluginHarness resumed(PluginKind::observer, "template_name");
  resumed.set("velocity", {0.0, 0.0});
  resumed.resume_from(first);
  resumed.set("velocity", {0.0, 1.0});
  const auto sample = resumed.sample();
  EXPECT_NEAR(sample.at("mean_speed").at(0), 1.0, 1e-12);
  EXPECT_NEAR(sample.at("highest").at(0), 5.0, 1e-12);
}

}  // namespace
