// Values at walls as a device finds them, by runs of neighbours and in its own memory: those of the host but for
// rounding, and nothing crosses.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "counting_memory.hpp"
#include "emulated_device.hpp"
#include "walled_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

class WallsByRuns : public testing::TestWithParam<std::tuple<const char*, Continuation, Precision>> {
 protected:
  static Sites sites() {
    const std::string scene = std::get<0>(GetParam());
    return scene == "channel" ? channel() : disc(scene == "dish");
  }
};

// Where particles are at first, after a little way, and after a sorting.
TEST_P(WallsByRuns, HaveTheValuesOfTheHost) {
  const auto [scene, along, precision] = GetParam();
  exec::EmulatedMemory memory;
  const EmulatedDevice backend(memory, false);
  Walled host(sites(), along, precision, Backend::host());
  Walled device(sites(), along, precision, backend);
  ASSERT_GT(host.state().neighbourhood.walls().count(), 100);
  const double tolerance = precision == Precision::double_precision ? 1e-12 : 1e-5;
  for (const double way : {0.0, 0.02, 0.3}) {
    host.move(way * spacing);
    device.move(way * spacing);
    for (const auto& [name, kind] : kinds) {
      const std::vector<double> expected = host.at_walls(name);
      const std::vector<double> found = device.at_walls(name);
      ASSERT_EQ(found.size(), expected.size());
      EXPECT_GT(largest(expected), 0.5) << name;
      for (std::size_t n = 0; n < found.size(); ++n)
        ASSERT_NEAR(found[n], expected[n], tolerance * largest(expected)) << name << ", number " << n;
    }
  }
  EXPECT_EQ(device.state().neighbourhood.sortings(), 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WallsByRuns,
                         testing::Combine(testing::Values("channel", "pillar", "dish"),
                                          testing::Values(Continuation::wrapped, Continuation::ghosts),
                                          testing::Values(Precision::single_precision, Precision::double_precision)));

// In a step and in a sorting, whatever the number of particles.
TEST(WallsOnADevice, LetNoFieldCross) {
  const auto copied = [](bool host_code, bool sorts) {
    CountingMemory memory;
    const EmulatedDevice backend(memory, host_code);
    Walled walled(channel(), Continuation::ghosts, Precision::double_precision, backend);
    walled.refresh();
    walled.touch();
    memory.copied = 0;
    if (sorts) walled.state().order.sort_anew();
    walled.state().order.settle();
    walled.refresh();
    return memory.copied;
  };
  for (const bool sorts : {false, true}) {
    EXPECT_LT(copied(false, sorts), 4'000U) << sorts;
    EXPECT_GT(copied(true, sorts), 40'000U) << sorts;
  }
}

// There are as many rows as the point of a group that sees most needs, and no more.
TEST(WallsOnADevice, KeepFewWeights) {
  exec::EmulatedMemory memory;
  const EmulatedDevice backend(memory, false);
  Walled walled(channel(), Continuation::wrapped, Precision::double_precision, backend);
  const Mirrors& mirrors = walled.state().neighbourhood.mirrors();
  const sph::MirrorPoints<2> points = mirrors.points<2>();  // the host plays the device: it may look
  ASSERT_EQ(points.count, 10 * across);
  std::size_t rows = 0;
  for (Index first = 0; first < points.count; first += 32) {
    std::size_t most = 0;
    for (Index n = first; n < std::min(first + 32, points.count); ++n) {
      std::size_t seen = 0;
      for (Index run = points.run_begin[n]; run < points.run_begin[n + 1]; ++run) seen += points.run[run].count;
      EXPECT_GT(seen, 15U);
      EXPECT_LT(seen, 75U);
      most = std::max(most, seen);
    }
    rows += most;
  }
  EXPECT_EQ(mirrors.weights<double>(), 32 * rows);
}

}  // namespace
