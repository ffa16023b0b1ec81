#include <gtest/gtest.h>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

TEST(Colour, FillsOneQuarterOfTheBox) {
  PluginHarness plugin(PluginKind::initial, "colour", "type = \"quarter\"");
  const auto x = plugin.position(0);
  const auto y = plugin.position(1);
  const auto colour = plugin.values("colour");
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(colour[i], x[i] < 0.5 && y[i] < 0.5 ? 1.0 : 0.0);
    sum += colour[i];
  }
  EXPECT_NEAR(sum / static_cast<double>(x.size()), 0.25, 0.01);
}

// A dye tells of mixing only where particles move.
TEST(Colour, IsRefusedWhereParticlesStay) {
  TestScene scene;
  scene.more = R"([physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.1
motion = "eulerian")";
  PluginHarness plugin(PluginKind::initial, "colour", "type = \"quarter\"", scene);
  try {
    (void)plugin.scene();
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("colour: in the Eulerian motion of 'physics.flow' particles stay where they are, so what it "
                        "sets would not move; remove it, or take motion = \"lagrangian\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
