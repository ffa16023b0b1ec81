// Advice about creeping flow, and flow between walls: each is followed, and does what it promises.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "followed.hpp"
#include "stokes_channel.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// An active film of 1e-6 kg in micrometres between walls, 40 x 20 um: Re = 3e-6.
CaseText film(double spacing) {
  CaseText text(20e-6, 1);
  text.section("domain", "size = [40e-6, 20e-6]\nboundary = { type = \"walls\", anchoring = \"planar\" }")
      .section("particles", fmt::format("spacing = {:.17g}", spacing))
      .precision("single")
      .section("director", "type = \"perturbed\"\namplitude = 0.05")
      .section("physics.flow", "type = \"wcsph\"\ndensity = 1000.0\nviscosity = 0.1")
      .nematic(1.0, 0.7, 4e-12)
      .active(0.5)
      .section("time", "end = 1.0\nstepping = \"explicit\"");
  return text;
}

TEST(Advice, WithoutInertiaACreepingFlowTakesFewerSteps) {
  const CaseText text = film(1e-6);
  const auto found = advised(text, "no_inertia");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings, std::vector<std::string>{"physics.flow.inertia=false"});
  EXPECT_NE(found->finding.find("the Reynolds number of the box is 2.8e-06"), std::string::npos) << found->finding;
  EXPECT_NE(found->gain.find("growth rates are up to 5 % too low"), std::string::npos) << found->gain;
  CaseRun before = CaseRun::unstarted(text);
  CaseRun after(text, found->settings);
  EXPECT_GT(forecast_steps(before.setup()).expected, 10000 * forecast_steps(after.setup()).expected);
  after.run_to(0.02);
  EXPECT_GT(after.observe("flow_statistics", "v_rms"), 0.0);
  expect_settled(text, *found);
}

// In stabilised steps, which sound limits either way.
TEST(Advice, WithoutInertiaAStabilisedStepTakesFewerStages) {
  const CaseText text = film(1e-6).section("time", "end = 1.0");
  const auto found = advised(text, "no_inertia");
  ASSERT_TRUE(found);
  EXPECT_NE(found->finding.find("the fluid's mass has no effect on this flow, but asks for many stages in a step"),
            std::string::npos)
      << found->finding;
  EXPECT_EQ(
      found->gain,
      "an artificial density that is 18000 times the fluid's, and 140 times fewer stages in a step; growth rates are "
      "up to 5 % too low");
  CaseRun before = CaseRun::unstarted(text);
  CaseRun after(text, found->settings);
  EXPECT_GT(forecast_steps(before.setup()).stages.at("velocity"),
            50 * forecast_steps(after.setup()).stages.at("velocity"));
  expect_settled(text, *found);
}

/// Across the channel two waves whose stress has a slope at the walls.
CaseText creeping_film(double spacing, const std::string& flow) {
  constexpr double phase = -1.5707963267948966;
  return film(spacing)
      .section("physics.flow", "type = \"wcsph\"\ndensity = 1000.0\nviscosity = 0.1\n" + flow)
      .section("director", fmt::format("type = \"modes\"\nmodes = [[0, 1, 0.4, {0}], [0, 2, 0.3, {0}]]", phase))
      .section("domain", "size = [8e-6, 20e-6]\nboundary = { type = \"walls\", anchoring = \"planar\" }")
      .section("time", "end = 1.0\nstepping = \"explicit\"");
}

double distance_from_stokes(CaseRun& run, std::size_t columns) {
  return profile_beside_stokes(run, {.columns = columns, .width = 20e-6, .activity = 0.5, .viscosity = 0.1}).distance;
}

TEST(Advice, ACreepingFlowTakesFewerStepsWithASlowerSound) {
  const CaseText text = creeping_film(0.8e-6, "inertia = false").section("time", "end = 1.0");
  const auto found = advised(text, "creeping_sound");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding,
            "the speed of sound is chosen for a density that varies by 0.01, but that of a creeping flow is "
            "artificial, and limits the step");
  EXPECT_EQ(found->settings, std::vector<std::string>{"physics.flow.density_variation=0.05"});
  EXPECT_EQ(
      found->gain,
      "up to 5 times fewer steps, with more stages each; the velocity lags behind its forces by about a step, then "
      "0.02 s");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  const auto speed = [&before](double time) {
    before.run_to(time);
    return before.observe("flow_statistics", "v_rms");
  };
  const double earlier = speed(0.98);
  const double change_in_a_step = std::abs(earlier / speed(1.0) - 1.0);
  after.run_to(1.0);
  EXPECT_GT(static_cast<double>(before.state().step) / static_cast<double>(after.state().step), 4.5);
  EXPECT_GT(change_in_a_step, 0.02);
  EXPECT_LT(distance_from_stokes(after, 10), distance_from_stokes(before, 10) + 1.2 * change_in_a_step);
  expect_settled(text, *found);
}

TEST(Advice, TheSoundOfACreepingFlowIsLeftWhereNothingIsGained) {
  const auto advised_with = [](const std::string& flow, const std::string& time = "end = 1.0") {
    return advised(creeping_film(0.8e-6, flow).section("time", time), "creeping_sound").has_value();
  };
  EXPECT_TRUE(advised_with("inertia = false"));
  EXPECT_FALSE(advised_with(""));  // the density is the fluid's
  EXPECT_FALSE(advised_with("inertia = false", "end = 1.0\nstepping = \"explicit\""));
  EXPECT_FALSE(advised_with("inertia = false", "end = 1.0\nstep = 0.001"));
  EXPECT_FALSE(advised_with("inertia = false\nsound_speed = 0.0006"));
  EXPECT_FALSE(advised_with("inertia = false\ndensity_variation = 0.02"));
  EXPECT_FALSE(advised(creeping_film(0.8e-6, "inertia = false").boundary("periodic_ghosts"), "creeping_sound"));
}

TEST(Advice, ASmallerSpacingBringsTheFlowBetweenWallsNearerToStokes) {
  const CaseText text = creeping_film(0.8e-6, "inertia = false\nrelaxation_ratio = 60");
  const auto found = advised(text, "flow_under_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings, std::vector<std::string>{"particles.spacing=4e-07"});
  EXPECT_EQ(found->finding, "the active length is only 3.5 spacings: between walls the velocity is off by some 7.2 %");
  EXPECT_EQ(found->gain, "the velocity is off by some 1.8 %, with 4 times as many particles");
  const auto distance = [](CaseRun& run, std::size_t columns) {
    run.run_to(0.04);
    return distance_from_stokes(run, columns);
  };
  CaseRun before(text);
  CaseRun after(text, found->settings);
  const double better = distance(after, 20);
  EXPECT_LT(better, 0.018);
  EXPECT_GT(distance(before, 10), 2.0 * better);
  expect_settled(text, *found);
}

// Where a spacing that small is out of reach, it is told all the same.
TEST(Advice, AFlowThatNoSpacingResolvesIsTold) {
  const auto found = advised(film(2e-6), "flow_under_resolved");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding,
            "the active length is only 1.4 spacings: between walls the velocity is off by more than 20 %");
  CaseRun run = CaseRun::unstarted(film(1e-6).nematic(1.0, 0.7, 4e-18));
  const auto all = advice({run.setup(), forecast_steps(run.setup()), 0.0});
  const auto hopeless =
      std::find_if(all.begin(), all.end(), [](const Suggestion& one) { return one.name == "flow_under_resolved"; });
  ASSERT_NE(hopeless, all.end());
  EXPECT_TRUE(hopeless->settings.empty());
  EXPECT_EQ(hopeless->gain,
            "an active length of 7 spacings needs 6.1e+06 times as many particles; instead, choose a smaller box, a "
            "smaller activity or a larger elastic constant");
}

TEST(Advice, TheSpacingIsLeftWhereItIsSmallOrThereAreNoWalls) {
  EXPECT_FALSE(advised(creeping_film(0.5e-6, ""), "flow_under_resolved"));
  // Its cores of 5 spacings are no finer than the flow needs.
  EXPECT_FALSE(advised(creeping_film(0.4e-6, ""), "core_over_resolved"));
  EXPECT_FALSE(advised(creeping_film(0.8e-6, "").boundary("periodic_ghosts"), "flow_under_resolved"));
  EXPECT_FALSE(advised(vortices().boundary("walls"), "flow_under_resolved"));
}

// Inertia matters above Re = 0.1; and where the artificial density is no larger there is nothing to gain.
TEST(Advice, InertiaIsLeftWhereItMatters) {
  EXPECT_FALSE(advised(vortices(), "no_inertia"));
  CaseText light = film(1e-6);
  light.section("physics.flow", "type = \"wcsph\"\ndensity = 5e8\nviscosity = 0.1");
  EXPECT_FALSE(advised(light, "no_inertia"));
}

}  // namespace
