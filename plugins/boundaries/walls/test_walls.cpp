#include <gtest/gtest.h>

#include <cmath>

#include "boundary_checks.hpp"
#include "case_run.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double reach = 0.41;

/// A boundary with its parameters, and a box of 1 m x 2 m with particles 0.1 m apart.
struct WallsUnderTest {
  std::unique_ptr<Boundary> boundary = built_plugins().make_boundary("walls", 2);
  ParameterList parameters;
  Scene scene = scene_of(2, {1.0, 2.0, 0.0});

  WallsUnderTest() {
    boundary->parameters(parameters);
    scene.spacing = 0.1;
  }
  template <class Value>
  WallsUnderTest& set(const std::string& name, const Value& value) {
    for (const Parameter& parameter : parameters.all())
      if (parameter.name == name) *std::get<Value*>(parameter.target) = value;
    return *this;
  }
  [[nodiscard]] std::vector<WallParticle> particles() const { return boundary->wall_particles(scene, reach); }
  [[nodiscard]] AffineRule rule(Rank rank, FieldRole role, const WallParticle& at) const {
    return boundary->wall_rule(scene, {rank, role, 2}, at);
  }
};

void expect_same(const AffineRule& rule) {
  for (int r = 0; r < rule.components(); ++r) {
    EXPECT_EQ(rule.summand(r), 0.0);
    for (int c = 0; c < rule.components(); ++c) EXPECT_EQ(rule.matrix(r, c), r == c ? 1.0 : 0.0);
  }
}

TEST(Walls, StandAcrossTheAxesThatTheCaseNames) {
  WallsUnderTest channel;
  EXPECT_EQ(channel.boundary->continuation(0), Continuation::wrapped);
  EXPECT_EQ(channel.boundary->continuation(1), Continuation::none);
  channel.set("axes", std::vector<std::string>{"x", "y"});
  EXPECT_FALSE(channel.boundary->periodic(0) || channel.boundary->periodic(1));
}

TEST(Walls, ContinueTheLatticeAsFarAsTheKernelReaches) {
  WallsUnderTest channel;
  EXPECT_EQ(channel.particles().size(), 2U * 5U * 10U);
  for (const auto& [at, mirror, normal, curvature, wall] : channel.particles()) {
    EXPECT_EQ(curvature, 0.0);
    EXPECT_EQ(wall, 0);
    EXPECT_TRUE(at[1] < 0.0 || at[1] > 2.0);
    EXPECT_NEAR(std::remainder(at[1] / 0.1 - 0.5, 1.0), 0.0, 1e-12);
    EXPECT_EQ(mirror[0], at[0]);
    EXPECT_NEAR(mirror[1], at[1] < 0.0 ? -at[1] : 4.0 - at[1], 1e-15);
    EXPECT_EQ(normal, (std::array<double, 3>{0.0, at[1] < 0.0 ? 1.0 : -1.0, 0.0}));
  }
  channel.set("axes", std::vector<std::string>{"x", "y"});
  EXPECT_EQ(channel.particles().size(), 20U * 30U - 10U * 20U) << "corners are filled too, once";
}

TEST(Walls, HoldVelocityAndOrderTensorHalfWayAndNothingElse) {
  WallsUnderTest channel;
  channel.set("velocity_low", -0.25).set("velocity_high", 0.5).set("anchoring", std::string("angle"));
  channel.set("angle_low", 0.0).set("angle_high", 45.0).set("order", 0.8);
  for (const WallParticle& at : channel.particles()) {
    const bool high = at.position[1] > 0.0;
    const AffineRule velocity = channel.rule(Rank::vector, FieldRole::velocity, at);
    const AffineRule tensor = channel.rule(Rank::order_tensor, FieldRole::state, at);
    EXPECT_TRUE(velocity.curved());
    EXPECT_FALSE(tensor.curved());
    EXPECT_EQ(velocity.matrix(0, 0), -1.0);
    EXPECT_EQ(velocity.matrix(0, 1), 0.0);
    EXPECT_EQ(velocity.summand(0), high ? 1.0 : -0.5);
    EXPECT_EQ(velocity.summand(1), 0.0);
    EXPECT_EQ(tensor.matrix(1, 1), -1.0);
    EXPECT_NEAR(tensor.summand(0), high ? 0.0 : 1.6, 1e-15);
    EXPECT_NEAR(tensor.summand(1), high ? 1.6 : 0.0, 1e-15);
    expect_same(channel.rule(Rank::scalar, FieldRole::state, at));
    expect_same(channel.rule(Rank::vector, FieldRole::derived, at));        // an acceleration
    expect_same(channel.rule(Rank::order_tensor, FieldRole::derived, at));  // a molecular field
  }
}

TEST(Walls, AnchorAlongOrAcrossThemselves) {
  WallsUnderTest box;
  box.set("axes", std::vector<std::string>{"x", "y"});
  for (const bool planar : {true, false}) {
    box.set("anchoring", std::string(planar ? "planar" : "homeotropic"));
    for (const WallParticle& wall : box.particles()) {
      const auto& at = wall.position;
      const double beyond_x = std::max(-at[0], at[0] - 1.0);
      const double beyond_y = std::max(-at[1], at[1] - 2.0);
      if (std::abs(beyond_x - beyond_y) < 1e-12) continue;  // on the diagonal of a corner
      const AffineRule tensor = box.rule(Rank::order_tensor, FieldRole::state, wall);
      EXPECT_NEAR(tensor.summand(0), (beyond_y > beyond_x) == planar ? 2.0 : -2.0, 1e-12);
    }
  }
  box.set("anchoring", std::string("none"));
  for (const WallParticle& at : box.particles()) expect_same(box.rule(Rank::order_tensor, FieldRole::state, at));
}

TEST(Walls, ReflectWhatPassedThem) {
  const WallsUnderTest channel;
  std::array<double, 3> position{1.25, -0.125, 0.0};
  std::array<std::int32_t, 3> images{};
  channel.boundary->keep_inside(channel.scene, position.data(), images.data());
  EXPECT_EQ(position, (std::array<double, 3>{0.25, 0.125, 0.0}));
  EXPECT_EQ(images, (std::array<std::int32_t, 3>{1, 0, 0}));
  position = {0.5, 2.125, 0.0};
  channel.boundary->keep_inside(channel.scene, position.data(), images.data());
  EXPECT_EQ(position[1], 1.875);
}

std::string refusal(const std::string& keys, bool nematic = true) {
  CaseText text(1.0, 16);
  text.section("domain", "size = [1.0, 1.0]\nboundary = { type = \"walls\", " + keys + " }").flow(0.1);
  if (nematic) text.nematic(1.0, 0.5, 0.01).section("director", "type = \"uniform\"");
  try {
    CaseRun run(text);
    return "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    const auto at = what.find("domain.boundary.");
    return at == std::string::npos ? what : what.substr(at + 16);
  }
}

TEST(Walls, RefuseWhatHasNoMeaning) {
  EXPECT_EQ(refusal("axes = []"), "axes: names no axis: without walls the boundary is \"periodic_wrap\"");
  EXPECT_EQ(refusal("axes = [\"y\", \"y\"]"), "axes: names \"y\" twice");
  EXPECT_EQ(refusal("anchoring = \"planar\", angle_low = 30.0"),
            "angle_low: has a meaning only with anchoring = \"angle\"");
  EXPECT_EQ(refusal("order = 0.5"), "order: has a meaning only at walls that anchor the director");
  EXPECT_EQ(refusal("anchoring = \"planar\"", false),
            "anchoring: needs a nematic: add a [physics.*] section with type = \"beris_edwards\", or leave it out");
  EXPECT_EQ(refusal("anchoring = \"planar\", order = 0.5"), "accepted");
}

TEST(Walls, AnchorTheDirectorOfTwoDimensionsAlone) {
  WallsUnderTest walls;
  walls.set("anchoring", std::string("planar"));
  walls.scene = scene_of(3, {1.0, 1.0, 1.0});
  walls.scene.constants["elastic_constant"] = 0.1;
  try {
    walls.boundary->prepare(walls.scene);
    FAIL();
  } catch (const BadParameter& error) {
    EXPECT_EQ(error.key(), "anchoring");
    EXPECT_STREQ(error.what(), "knows the director of two dimensions alone: leave it out");
  }
}

TEST(Walls, TellHowFastTheyMove) {
  WallsUnderTest channel;
  channel.set("velocity_low", -0.25);
  Scales scales;
  channel.boundary->scales(scales);
  EXPECT_EQ(scales.speed, 0.25);
}

// Particles at random places, the fields read in the walls: a linear field stays linear across the wall, so its
// gradient is exact up to it.
TEST(Walls, LinearFieldsStayLinearAcrossThem) {
  CaseText text(1.0, 16);
  text.section("domain", R"(size = [1.0, 1.0]
boundary = { type = "walls", velocity_low = 0.0, velocity_high = 1.0 })");
  text.section("particles", "spacing = 0.0625\narrangement = \"jittered\"").flow(0.1).read("\"velocity_gradient\"");
  CaseRun run(text);
  const auto y = run.path(1);
  Field& velocity = run.state().fields.at("velocity");
  for (Index i = 0; i < run.state().particles.count(); ++i) {
    velocity.set(0, i, run.state().particles.position[1].host()[static_cast<std::size_t>(i)]);
    velocity.set(1, i, 0.0);
  }
  ++velocity.version;
  const auto slope = run.field("velocity_gradient", 1);
  for (std::size_t i = 0; i < slope.size(); ++i) EXPECT_NEAR(slope[i], 1.0, 1e-11) << "at y = " << y[i];
}

/// Disordered particles with the velocity (u, u) in a box with such walls, which keep its Laplacian.
template <class Function>
CaseRun laplacian_between_walls(int across, const std::string& walls, const Function& u) {
  CaseText text(1.0, across);
  text.section("domain", "size = [1.0, 1.0]\nboundary = { type = \"walls\", " + walls + " }");
  text.section("particles", "spacing = " + std::to_string(1.0 / across) + "\narrangement = \"jittered\"")
      .kernel("quintic", "consistent")
      .flow(0.1)
      .read("\"velocity_laplacian\"");
  CaseRun run(text);
  Field& velocity = run.state().fields.at("velocity");
  const auto& position = run.state().particles.position;
  for (Index i = 0; i < run.state().particles.count(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (const int c : {0, 1}) velocity.set(c, i, u(position[0].host()[at], position[1].host()[at]));
  }
  ++velocity.version;
  return run;
}

// The part of the velocity along the walls goes on behind them with its curvature, also where they move.
TEST(Walls, KeepTheCurvatureOfTheVelocityAlongThem) {
  CaseRun run = laplacian_between_walls(16, "velocity_low = -0.25, velocity_high = 0.5",
                                        [](double, double y) { return -0.25 + 0.75 * y + y * (1.0 - y); });
  const auto at = run.path(1);
  const auto along = run.field("velocity_laplacian", 0);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(along[i], -2.0, 1e-9) << "at y = " << at[i];
}

TEST(Walls, ReflectTheVelocityAcrossThemStraight) {
  CaseRun run = laplacian_between_walls(16, "axes = [\"y\"]", [](double, double y) { return y * (1.0 - y); });
  const auto at = run.path(1);
  const auto across = run.field("velocity_laplacian", 1);
  int beside = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (std::min(at[i], 1.0 - at[i]) > 0.05) continue;
    EXPECT_GT(across[i], -1.5) << "at y = " << at[i];
    ++beside;
  }
  EXPECT_GT(beside, 16);
}

/// Largest error of the Laplacian of sin(pi x) sin(pi y) within 3 spacings of a corner of a closed box, relative to its
/// largest value.
double error_in_corners(int across) {
  const auto wave = [](double x, double y) { return std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y); };
  CaseRun run = laplacian_between_walls(across, "axes = [\"x\", \"y\"]", wave);
  const auto x = run.path(0);
  const auto y = run.path(1);
  double worst = 0.0;
  for (const int c : {0, 1}) {
    const auto laplacian = run.field("velocity_laplacian", c);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::max(std::min(x[i], 1.0 - x[i]), std::min(y[i], 1.0 - y[i])) > 3.0 / across) continue;
      worst = std::max(worst, std::abs(laplacian[i] / (2.0 * std::pow(std::numbers::pi, 2)) + wave(x[i], y[i])));
    }
  }
  return worst;
}

// Behind a corner values are reflected by the rule of the farther wall alone: an error that is bounded, but stays.
TEST(Walls, ContinueTheVelocityIntoCorners) {
  EXPECT_LT(error_in_corners(16), 0.1);
  EXPECT_LT(error_in_corners(64), 0.1);
}

TEST(Walls, FillTheSupportOfALattice) {
  CaseText text(1.0, 16);
  text.section("domain", R"(size = [1.0, 1.0]
boundary = { type = "walls", axes = ["x", "y"] })")
      .flow(0.1)
      .read("\"volume\"");
  CaseRun run(text);
  const auto volume = run.field("volume");
  for (const double v : volume) EXPECT_NEAR(v * 256.0, volume.front() * 256.0, 1e-12);
}

}  // namespace
