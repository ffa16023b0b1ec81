// Coordinates in pair sums are relative to tiles: float stays exact far from the origin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

class LongBox : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] ParticleScene scene(Precision precision, int columns, double spacing) const {
    ParticleScene::Options options;
    constexpr int rows = 10;
    options.spacing = spacing;
    options.box = {columns * spacing, rows * spacing, 0.0};
    options.boundary = GetParam();
    options.precision = precision;
    return {options, jittered(columns, rows, spacing, 0.2)};
  }
};

TEST_P(LongBox, FloatAgreesWithDoubleFarFromTheOrigin) {
  // 20000 spacings of 0.3 m: plain floats are 0.0005 m apart there, which would show as 2e-3 in a volume.
  constexpr int columns = 20000;
  ParticleScene exact = scene(Precision::double_precision, columns, 0.3);
  ParticleScene single = scene(Precision::single_precision, columns, 0.3);
  const auto expected = exact.derived("volume");
  const auto volume = single.derived("volume");
  double most = 0.0;
  for (std::size_t i = 0; i < volume.size(); ++i) most = std::max(most, std::abs(volume[i] / expected[i] - 1.0));
  EXPECT_LT(most, 1e-5);
}

TEST_P(LongBox, VolumesOfALatticeAreTheSameInEveryTile) {
  ParticleScene::Options options;
  options.spacing = 0.3;
  options.box = {300 * 0.3, 10 * 0.3, 0.0};
  options.boundary = GetParam();
  options.precision = Precision::single_precision;
  ParticleScene all(options, lattice(300, 10, 0.3));
  const auto volume = all.derived("volume");
  const auto [least, most] = std::minmax_element(volume.begin(), volume.end());
  EXPECT_LT(*most / *least - 1.0, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, LongBox, testing::Values("periodic_ghosts", "periodic_wrap"),
                         [](const auto& set) { return std::string(set.param); });

}  // namespace
