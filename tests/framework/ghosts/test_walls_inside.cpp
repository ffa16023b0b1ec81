// Walls are a set of particles of their own: they may stand in the middle of the box, across a periodic face, and
// beside periodic axes of either kind.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boundary_checks.hpp"
#include "particle_scene.hpp"
#include "plugin/way_to_mirror.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr int across = 24;
constexpr double spacing = 1.0 / across;

/// Walls on the sites of the particles' lattice that a test picks, each mirrored at the nearest surface.
class Picked final : public Boundary {
 public:
  Picked(Continuation along_x, Continuation along_y, std::vector<WallParticle> walls)
      : continuation_{along_x, along_y}, walls_(std::move(walls)) {}
  [[nodiscard]] Continuation continuation(int axis) const override { return continuation_[axis == 0 ? 0 : 1]; }
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene&, double) const override { return walls_; }
  [[nodiscard]] AffineRule wall_rule(const Scene&, const FieldKind& field, const WallParticle&) const override {
    return AffineRule::curved_at(field, std::array{0.25});
  }

 private:
  std::array<Continuation, 2> continuation_;
  std::vector<WallParticle> walls_;
};

struct Sites {
  std::vector<WallParticle> walls;
  std::array<std::vector<double>, 2> fluid;
};

double site(int n) { return (n + 0.5) * spacing; }

/// A box with a wall of 10 columns, from bottom to top, that begins at column `first` and may go on at column 0.
Sites with_wall(int first) {
  Sites sites;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) {
      const int inside = (column - first + across) % across;
      if (inside >= 10) {
        sites.fluid[0].push_back(site(column));
        sites.fluid[1].push_back(site(row));
        continue;
      }
      const bool low = inside < 5;  // mirrored at the surface on its left
      const int mirror = low ? first - 1 - inside : first + 10 + (9 - inside);
      sites.walls.push_back({.position = {site(column), site(row), 0.0},
                             .mirror = {site((mirror + across) % across), site(row), 0.0},
                             .normal = {low ? -1.0 : 1.0, 0.0, 0.0}});
    }
  return sites;
}

ParticleScene scene_with(const Sites& sites, Continuation along_x, Continuation along_y, Precision precision,
                         bool consistent_laplacian = false) {
  ParticleScene::Options options;
  options.spacing = spacing;
  options.consistent_laplacian = consistent_laplacian;
  options.precision = precision;
  return {options, sites.fluid, std::make_unique<Picked>(along_x, along_y, sites.walls)};
}

class WallsInside : public testing::TestWithParam<std::tuple<Continuation, Continuation, int, Precision>> {};

// The fluid sees every wall particle once, also across a periodic face.
TEST_P(WallsInside, CompleteTheSupport) {
  const auto [along_x, along_y, first, precision] = GetParam();
  ParticleScene scene = scene_with(with_wall(first), along_x, along_y, precision);
  EXPECT_GE(scene.state().neighbourhood.walls().count(), 10 * across);
  const auto volume = scene.derived("volume");
  const auto [least, most] = std::ranges::minmax(volume);
  EXPECT_LT(most / least - 1.0, precision == Precision::double_precision ? 1e-12 : 1e-5);
}

// A field that is 0.25 at both surfaces and linear beside them continues linearly into the wall.
TEST_P(WallsInside, ContinueALinearField) {
  const auto [along_x, along_y, first, precision] = GetParam();
  ParticleScene scene = scene_with(with_wall(first), along_x, along_y, precision);
  scene.state().fields.at("f").kind = FieldKind{Rank::scalar, FieldRole::state, 2};
  const double left = first * spacing;  // where the wall begins; the fluid there ends
  const double right = std::fmod(left + 10 * spacing, 1.0);
  const auto way = [](double from, double to) { return to - from - std::round(to - from); };
  scene.set([&](double x, double) {
    return std::abs(way(right, x)) < std::abs(way(left, x)) ? 0.25 + way(right, x) : 0.25 - way(left, x);
  });
  const auto slope = scene.derived("f_gradient", 0);
  const auto across_it = scene.derived("f_gradient", 1);
  const State& state = scene.state();
  const double tolerance = precision == Precision::double_precision ? 1e-11 : 1e-4;
  for (std::size_t i = 0; i < state.particles.id.size(); ++i) {
    const auto id = static_cast<std::size_t>(state.particles.id.host()[i]);
    const double x = state.particles.position[0].host()[i];
    const bool at_right = std::abs(way(right, x)) < 2 * spacing;
    if (at_right || std::abs(way(left, x)) < 2 * spacing) {
      EXPECT_NEAR(slope[id], at_right ? 1.0 : -1.0, tolerance) << "at x = " << x;
    }
    EXPECT_NEAR(across_it[id], 0.0, tolerance);
  }
}

// One that is quadratic beside them continues quadratically, and so do its second derivatives.
TEST_P(WallsInside, ContinueAQuadraticField) {
  const auto [along_x, along_y, first, precision] = GetParam();
  ParticleScene scene = scene_with(with_wall(first), along_x, along_y, precision, true);
  scene.state().fields.at("f").kind = FieldKind{Rank::scalar, FieldRole::state, 2};
  const double left = first * spacing;
  const double right = std::fmod(left + 10 * spacing, 1.0);
  const auto way = [](double from, double to) { return to - from - std::round(to - from); };
  const auto distance = [&](double x) { return std::min(std::abs(way(right, x)), std::abs(way(left, x))); };
  scene.set([&](double x, double) { return 0.25 + distance(x) + 3.0 * distance(x) * distance(x); });
  const auto laplacian = scene.derived("f_laplacian");
  const State& state = scene.state();
  const double tolerance = precision == Precision::double_precision ? 1e-9 : 2e-2;
  int seen = 0;
  for (std::size_t i = 0; i < state.particles.id.size(); ++i) {
    const double x = state.particles.position[0].host()[i];
    if (distance(x) > 2 * spacing) continue;  // the two parabolas meet half way between the surfaces
    EXPECT_NEAR(laplacian[static_cast<std::size_t>(state.particles.id.host()[i])], 6.0, tolerance) << "at x = " << x;
    ++seen;
  }
  EXPECT_EQ(seen, 4 * across);
}

INSTANTIATE_TEST_SUITE_P(Boxes, WallsInside,
                         testing::Combine(testing::Values(Continuation::wrapped, Continuation::ghosts),
                                          testing::Values(Continuation::wrapped, Continuation::ghosts),
                                          testing::Values(7, 19),
                                          testing::Values(Precision::single_precision, Precision::double_precision)));

// A wall may be thicker than half the box: the normal tells on which side of it the mirror point lies.
TEST(WayToMirror, IsToTheImageOnTheSideOfTheNormal) {
  const Picked boundary(Continuation::ghosts, Continuation::none, {});
  const Scene scene = scene_of(2, {1.0, 1.0, 0.0});
  const auto along_x = [&](double normal) {
    return way_to_mirror(scene, boundary, {{0.05, 0.2, 0.0}, {0.65, 0.2, 0.0}, {normal, 0.0, 0.0}})[0];
  };
  EXPECT_NEAR(along_x(1.0), 0.6, 1e-15);
  EXPECT_NEAR(along_x(-1.0), -0.4, 1e-15);
  const auto beyond = way_to_mirror(scene, boundary, {{0.5, -0.1, 0.0}, {0.5, 0.9, 0.0}, {0.0, -1.0, 0.0}});
  EXPECT_NEAR(beyond[1], 1.0, 1e-15) << "the box ends there";
}

/// Walls across y and disordered fluid between them.
Sites disordered_channel() {
  Sites sites;
  sites.fluid = jittered(across, across, spacing, 0.3);
  for (int layer = 0; layer < 5; ++layer)
    for (int column = 0; column < across; ++column) {
      const double depth = site(layer);
      sites.walls.push_back({{site(column), -depth, 0.0}, {site(column), depth, 0.0}, {0.0, 1.0, 0.0}});
      sites.walls.push_back({{site(column), 1.0 + depth, 0.0}, {site(column), 1.0 - depth, 0.0}, {0.0, -1.0, 0.0}});
    }
  return sites;
}

std::vector<double> slopes_in_channel(Continuation along_x, int component) {
  ParticleScene scene = scene_with(disordered_channel(), along_x, Continuation::none, Precision::double_precision);
  scene.state().fields.at("f").kind = FieldKind{Rank::scalar, FieldRole::state, 2};
  scene.set([](double x, double y) { return std::sin(2.0 * std::numbers::pi * x) * std::cos(3.0 * y); });
  return scene.derived("f_gradient", component);
}

TEST(WallsBesideGhosts, AreTheSameAsBesideAWrappedAxis) {
  for (int c = 0; c < 2; ++c) {
    const auto wrapped = slopes_in_channel(Continuation::wrapped, c);
    const auto ghosts = slopes_in_channel(Continuation::ghosts, c);
    for (std::size_t i = 0; i < wrapped.size(); ++i) EXPECT_NEAR(ghosts[i], wrapped[i], 1e-11) << "particle " << i;
  }
}

TEST(WallsBesideGhosts, ContinueAQuadraticFieldOfDisorderedFluid) {
  ParticleScene scene =
      scene_with(disordered_channel(), Continuation::ghosts, Continuation::none, Precision::double_precision, true);
  scene.state().fields.at("f").kind = FieldKind{Rank::scalar, FieldRole::state, 2};
  scene.set([](double, double y) { return 0.25 + 2.0 * y * (1.0 - y); });
  for (const double laplacian : scene.derived("f_laplacian")) EXPECT_NEAR(laplacian, -4.0, 1e-8);
}

}  // namespace
