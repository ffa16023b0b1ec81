// Solids in a scene: where particles are placed, and what holds at surfaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"
#include "ghosts/wall_set.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double radius = 0.4;

/// A dish, or with `fluid` outside a pillar, in the middle of a box of 1.2 m, 48 particles across.
CaseText disc(const std::string& fluid, const std::string& more = "") {
  CaseText text(1.2, 48);
  text.section("solids.rim", "shape = \"disc\"\ncentre = [0.6, 0.6]\nradius = 0.4\nfluid = \"" + fluid + "\"\n" + more)
      .flow(0.1);
  return text;
}

double from_centre(CaseRun& run, std::size_t n) { return std::hypot(run.path(0)[n] - 0.6, run.path(1)[n] - 0.6); }

TEST(Solids, LeaveTheFluidItsVolume) {
  CaseRun dish(disc("inside"));
  const double area = std::numbers::pi * radius * radius;
  EXPECT_NEAR(dish.setup().scene.fluid_volume / area, 1.0, 2e-3);
  EXPECT_NEAR(static_cast<double>(dish.setup().scene.particle_count) * 0.025 * 0.025 / area, 1.0, 0.01);
  EXPECT_NEAR(dish.setup().scene.widest, 2.0 * radius, 0.05);
  CaseRun pillar(disc("outside"));
  EXPECT_NEAR(pillar.setup().scene.fluid_volume, 1.44 - area, 1e-3);
}

// Half a spacing from the surface stands a row of particles, on both sides, and they are evenly spread.
TEST(Solids, FitParticlesToTheirSurface) {
  for (const char* const fluid : {"inside", "outside"}) {
    CaseRun run(disc(fluid).read("\"volume\""));
    const double dx = 0.025;
    const double sign = std::string(fluid) == "inside" ? 1.0 : -1.0;
    const auto x = run.path(0);
    const auto y = run.path(1);
    double nearest = 1.0;
    std::array<double, 64> gap{};
    gap.fill(1.0);
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double depth = sign * (radius - std::hypot(x[n] - 0.6, y[n] - 0.6));
      nearest = std::min(nearest, depth);
      for (std::size_t a = 0; a < gap.size(); ++a) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(a) / 64.0;
        gap[a] =
            std::min(gap[a], std::hypot(x[n] - 0.6 - radius * std::cos(angle), y[n] - 0.6 - radius * std::sin(angle)));
      }
    }
    EXPECT_NEAR(nearest, 0.5 * dx, 0.02 * dx) << fluid;
    EXPECT_LT(*std::ranges::max_element(gap), 0.9 * dx) << fluid;  // half a spacing away, half a spacing aside: 0.71
    const auto volume = run.field("volume");
    const auto [least, most] = std::ranges::minmax(volume);
    EXPECT_GT(least / (dx * dx), 0.95) << fluid;
    EXPECT_LT(most / (dx * dx), 1.05) << fluid;
  }
}

// A linear field goes on exactly, whatever the particles' places, so its gradient is exact up to the surface.
TEST(Solids, LinearFieldsStayLinearAcrossTheirSurface) {
  CaseRun run(disc("inside", "angular_velocity = 0.5").read("\"velocity_gradient\""));
  Field& velocity = run.state().fields.at("velocity");
  for (Index i = 0; i < run.state().particles.count(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    velocity.set(0, i, -0.5 * (run.state().particles.position[1].host()[n] - 0.6));
    velocity.set(1, i, 0.5 * (run.state().particles.position[0].host()[n] - 0.6));
  }
  ++velocity.version;
  const auto slope = run.field("velocity_gradient", 1);
  for (std::size_t n = 0; n < slope.size(); ++n)
    EXPECT_NEAR(slope[n], -0.5, 0.02) << "at " << from_centre(run, n) << " m from the centre";
}

struct OfSurface {
  AffineRule rule;
  double depth;
  double angle;  // of the normal
};

/// Rules of the wall particles that lie at a depth of 0.5 to 0.6 spacings.
std::vector<OfSurface> rules(CaseRun& run, Rank rank, FieldRole role) {
  std::vector<OfSurface> all;
  const Scene& scene = run.setup().scene;
  for (const WallParticle& wall : run.setup().boundary->wall_particles(scene, scene.support)) {
    const double depth = 0.5 * std::hypot(wall.mirror[0] - wall.position[0], wall.mirror[1] - wall.position[1]);
    all.push_back({run.setup().boundary->wall_rule(scene, {rank, role, 2}, wall), depth,
                   std::atan2(wall.normal[1], wall.normal[0])});
  }
  return all;
}

TEST(Solids, HoldTheVelocityOfTheirSurface) {
  CaseRun run(disc("inside", "velocity = [0.1, 0.0]\nangular_velocity = 0.5"));
  for (const OfSurface& at : rules(run, Rank::vector, FieldRole::velocity)) {
    EXPECT_TRUE(at.rule.curved());
    // The normal points inwards: the surface is at the opposite angle.
    EXPECT_NEAR(at.rule.at_wall(0), 0.1 + 0.5 * radius * std::sin(at.angle), 1e-6);
    EXPECT_NEAR(at.rule.at_wall(1), -0.5 * radius * std::cos(at.angle), 1e-6);
  }
}

// Along the surface a velocity g (b + s) at the distance s from it is g (b - s) behind it; across it changes sign.
TEST(Solids, LetTheFluidSlip) {
  for (const auto& [slip, length] : {std::pair("\"free\"", 1e30), {"0.05", 0.05}}) {
    CaseRun run(disc("inside", std::string("slip = ") + slip));
    for (const OfSurface& at : rules(run, Rank::vector, FieldRole::velocity)) {
      const double c = std::cos(at.angle);
      const double s = std::sin(at.angle);
      const double share = (length - at.depth) / (length + at.depth);
      EXPECT_NEAR(-s * (at.rule.matrix(0, 0) * -s + at.rule.matrix(0, 1) * c) +
                      c * (at.rule.matrix(1, 0) * -s + at.rule.matrix(1, 1) * c),
                  share, 1e-6);
      EXPECT_NEAR(at.rule.matrix(0, 0) * c + at.rule.matrix(0, 1) * s, -c, 1e-6);
      EXPECT_NEAR(at.rule.matrix(1, 0) * c + at.rule.matrix(1, 1) * s, -s, 1e-6);
    }
  }
}

TEST(Solids, AnchorTheDirector) {
  const auto anchored = [](const std::string& keys) {
    CaseText text = disc("inside", keys);
    text.nematic(1.0, 0.5, 0.01).section("director", "type = \"uniform\"");
    return CaseRun(text);
  };
  for (const auto& [keys, from_normal] : {std::pair("anchoring = \"normal\"", 0.0),
                                          {"anchoring = \"tangential\"", 90.0},
                                          {"anchoring = \"angle\"\nangle = 30.0", -60.0}}) {
    CaseRun run = anchored(keys);
    for (const OfSurface& at : rules(run, Rank::order_tensor, FieldRole::state)) {
      const double angle = at.angle + from_normal * std::numbers::pi / 180.0;
      EXPECT_NEAR(at.rule.summand(0), 2.0 * std::cos(2.0 * angle), 1e-5) << keys;
      EXPECT_NEAR(at.rule.summand(1), 2.0 * std::sin(2.0 * angle), 1e-5) << keys;
      EXPECT_EQ(at.rule.matrix(0, 0), -1.0);
    }
  }
  CaseRun weak = anchored("anchoring = \"normal\"\nanchoring_strength = 0.2\norder = 0.5");
  for (const OfSurface& at : rules(weak, Rank::order_tensor, FieldRole::state)) {
    const double share = (0.05 - at.depth) / (0.05 + at.depth);  // K / W = 0.05 m
    EXPECT_NEAR(at.rule.matrix(1, 1), share, 1e-6);
    EXPECT_NEAR(at.rule.summand(0), (1.0 - share) * 0.5 * std::cos(2.0 * at.angle), 1e-5);
  }
}

TEST(Solids, BringParticlesBack) {
  CaseRun run(disc("inside"));
  const Boundary& boundary = *run.setup().boundary;
  std::array<double, 3> at{0.6 + 0.43, 0.6, 0.0};
  std::array<std::int32_t, 3> images{};
  EXPECT_TRUE(boundary.strays(at.data()));
  boundary.keep_inside(run.setup().scene, at.data(), images.data());
  EXPECT_NEAR(at[0], 0.6 + 0.37, 1e-8);
  EXPECT_FALSE(boundary.strays(at.data()));
}

// Two overlapping discs of fluid inside: a lens, whose tips belong to both.
TEST(Solids, OverlapAsALens) {
  CaseText text(1.2, 48);
  const auto arc = [&](const std::string& name, const std::string& x) {
    text.section("solids." + name, "shape = \"disc\"\ncentre = [" + x + ", 0.6]\nradius = 0.35\nfluid = \"inside\"");
  };
  arc("left", "0.45");
  arc("right", "0.75");
  text.flow(0.1);
  CaseRun run(text);
  for (std::size_t n = 0; n < run.path(0).size(); ++n) {
    EXPECT_LT(std::hypot(run.path(0)[n] - 0.45, run.path(1)[n] - 0.6), 0.35);
    EXPECT_LT(std::hypot(run.path(0)[n] - 0.75, run.path(1)[n] - 0.6), 0.35);
  }
  const Scene& scene = run.setup().scene;
  for (const WallParticle& wall : run.setup().boundary->wall_particles(scene, scene.support))
    EXPECT_FALSE(run.setup().boundary->strays(wall.mirror.data())) << wall.position[0] << ", " << wall.position[1];
}

std::string refusal(const CaseText& text) {
  try {
    CaseRun run(text);
    return "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    const auto at = what.find(": solids");
    return at == std::string::npos ? what : what.substr(at + 2);
  }
}

TEST(Solids, AreRefusedWhereTheyDoNotFit) {
  CaseText whole(1.2, 48);
  whole.section("solids.all", "shape = \"disc\"\ncentre = [0.6, 0.6]\nradius = 2.0").flow(0.1);
  EXPECT_EQ(refusal(whole), "solids: the solids fill the whole box: no fluid is left");
  CaseText outside(1.2, 48);
  outside.boundary("walls").section("solids.far", "shape = \"disc\"\ncentre = [0.6, 2.0]\nradius = 0.2").flow(0.1);
  EXPECT_EQ(refusal(outside),
            "solids: solids.far touches no fluid: it lies outside of the box, in another solid, or between particles");
  CaseText gap(1.2, 48);
  gap.section("solids.a", "shape = \"disc\"\ncentre = [0.3, 0.6]\nradius = 0.2")
      .section("solids.b", "shape = \"disc\"\ncentre = [0.8, 0.6]\nradius = 0.2")
      .flow(0.1);
  EXPECT_EQ(refusal(gap).find("solids: solids.a and solids.b are 0.1"), 0U) << refusal(gap);
  EXPECT_NE(refusal(gap).find("must be at least two supports of the kernel wide, 0.2 m"), std::string::npos);
  CaseText pocket(1.2, 48);
  pocket.section("solids.ring", "shape = \"disc\"\ncentre = [0.6, 0.6]\nradius = 0.05\nfluid = \"inside\"").flow(0.1);
  EXPECT_EQ(refusal(pocket).find("solids: the solids cut off a pocket of "), 0U) << refusal(pocket);
  CaseText torn(1.2, 48);
  torn.section("solids.step", "shape = \"polygon\"\npoints = [[0.0, -1.0], [1.2, -1.0], [1.2, 0.6], [0.0, 0.3]]")
      .flow(0.1);
  EXPECT_NE(refusal(torn), "accepted");
}

TEST(Solids, AreRefusedWithKeysThatMeanNothing) {
  EXPECT_EQ(refusal(disc("inside", "anchoring = \"normal\"")).find("solids.rim.anchoring: needs a nematic: add a"), 0U);
  EXPECT_EQ(refusal(disc("inside", "angle = 30.0")).find("solids.rim.angle: has a meaning only with anchoring"), 0U);
  EXPECT_EQ(
      refusal(disc("inside", "slip = \"some\"")).find("solids.rim.slip: must be a \"none\", \"free\" or number in m"),
      0U)
      << refusal(disc("inside", "slip = \"some\""));
  EXPECT_EQ(refusal(disc("inside", "slip = -0.1")).find("solids.rim.slip: must be >= 0 m"), 0U)
      << refusal(disc("inside", "slip = -0.1"));
  CaseText unnamed(1.2, 48);
  unnamed.section("solids.rim", "radius = 0.4").flow(0.1);
  EXPECT_EQ(refusal(unnamed).find("solids.rim.shape: must be given: a text (name of the plugin)"), 0U)
      << refusal(unnamed);
  CaseText mesh(1.2, 48);
  mesh.section("solids.rim", "shape = \"disc\"\ncentre = [0.6, 0.6]\nradius = 0.2")
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.1");
  EXPECT_NE(refusal(mesh).find("an incompressible flow knows no solids"), std::string::npos) << refusal(mesh);
}

}  // namespace
