#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

const std::string arrow = "points = [[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.5, 0.4]]\n";

TEST(Polygon, IsAsFarAsItsEdgesAndCorners) {
  PluginHarness plugin(PluginKind::shape, "polygon", arrow);
  const Shape& polygon = plugin.shape();
  EXPECT_NEAR(polygon.distance({0.7, 0.25, 0.0}), -0.05, 1e-15);
  EXPECT_NEAR(polygon.distance({0.6, 0.1, 0.0}), 0.1, 1e-15);
  EXPECT_NEAR(polygon.distance({0.83, 0.16, 0.0}), 0.05, 1e-15);  // 3, 4, 5
  EXPECT_GT(polygon.distance({0.4, 0.5, 0.0}), 0.0);              // before the notch
}

TEST(Polygon, HasItsCentreOfArea) {
  PluginHarness plugin(PluginKind::shape, "polygon", "points = [[0.2, 0.2], [0.8, 0.2], [0.2, 0.8]]");
  EXPECT_NEAR(plugin.shape().centre()[0], 0.4, 1e-15);
  EXPECT_NEAR(plugin.shape().centre()[1], 0.4, 1e-15);
}

TEST(Polygon, ReadsItsCornersFromAFile) {
  const auto file = std::filesystem::temp_directory_path() / "mesogen_polygon.txt";
  std::ofstream(file) << "# corners\n0.2 0.2\n0.8 0.2\n\n0.8 0.8\n0.5 0.4\n";
  PluginHarness plugin(PluginKind::shape, "polygon", "file = \"" + file.string() + "\"");
  EXPECT_NEAR(plugin.shape().distance({0.7, 0.25, 0.0}), -0.05, 1e-15);
  std::filesystem::remove(file);
}

std::string refusal(const std::string& keys) {
  try {
    (void)PluginHarness(PluginKind::shape, "polygon", keys).scene();
    return "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    const auto at = what.find("solids.tested.");
    return at == std::string::npos ? what : what.substr(at + 14);
  }
}

TEST(Polygon, RefusesWhatIsNone) {
  EXPECT_EQ(refusal("points = [[0.2, 0.2], [0.8, 0.2]]"),
            "points: a polygon has at least three corners, but here are 2");
  EXPECT_EQ(refusal("points = [[0.2, 0.2], [0.8, 0.8], [0.8, 0.2], [0.2, 0.8]]"),
            "points: the edges from corner 1 and from corner 3 cross each other: give the corners in order around it");
  EXPECT_EQ(refusal(arrow + "file = \"corners.txt\""), "file: must not be given beside points");
  EXPECT_EQ(refusal("file = \"no such file\""),
            "file: \"no such file\" cannot be read; it is looked for where mesogen was started");
  const auto file = std::filesystem::temp_directory_path() / "mesogen_polygon_wrong.txt";
  std::ofstream(file) << "0.2 0.2\n0.8, 0.2\n";
  EXPECT_EQ(refusal("file = \"" + file.string() + "\""),
            "file: line 2 of \"" + file.string() + "\" is no pair of numbers: \"0.8, 0.2\"");
  std::filesystem::remove(file);
}

}  // namespace
