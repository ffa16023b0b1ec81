// Where forces conserve momentum, the mean velocity of a run is kept; where they do not, it is left alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "active_scene.hpp"
#include "run/kept_momentum.hpp"

namespace mesogen::test {
namespace {

CaseText active(const std::string& boundary = "periodic_ghosts", const std::string& stepping = "explicit") {
  return freely_active_scene("double", boundary, stepping);
}

double mean_velocity(CaseRun& run, int axis) {
  const auto values = run.field("velocity", axis);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class KeptMomentumOf : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(KeptMomentumOf, IsThatOfTheStart) {
  CaseRun run(freely_active_scene(std::get<0>(GetParam()), "periodic_ghosts", std::get<1>(GetParam())));
  run.run_steps(7);
  EXPECT_GT(std::abs(mean_velocity(run, 0) - 1.0), 1e-9);  // what sums over neighbours leave
  EXPECT_GT(std::abs(mean_velocity(run, 1) + 0.6), 1e-9);
  run.run_steps(1);
  EXPECT_NEAR(mean_velocity(run, 0), 1.0, 1e-14);
  EXPECT_NEAR(mean_velocity(run, 1), -0.6, 1e-14);
  // What passes see is the same.
  State& state = run.state();
  if (std::get<0>(GetParam()) == std::string("single")) {
    const Field& velocity = state.fields.at("velocity");
    const auto seen = velocity.view<float>(exec::Side::host);
    for (Index i = 0; i < state.particles.count(); ++i) EXPECT_EQ(seen(0, i), static_cast<float>(velocity.value(0, i)));
  }
}

INSTANTIATE_TEST_SUITE_P(All, KeptMomentumOf,
                         testing::Combine(testing::Values("single", "double"),
                                          testing::Values("explicit", "stabilised")),
                         [](const auto& set) {
                           return std::string(std::get<0>(set.param)) + "_" + std::get<1>(set.param);
                         });

TEST(KeptMomentum, IsOfScenesWhoseForcesConserveIt) {
  const auto conserves = [](const CaseText& text) { return conserves_momentum(CaseRun::unstarted(text).setup()); };
  EXPECT_TRUE(conserves(active()));
  EXPECT_TRUE(conserves(active("periodic_wrap", "stabilised")));
  EXPECT_FALSE(conserves(active("walls")));
  for (const char* const stepping : {"explicit", "stabilised"}) {
    CaseText braked = active("periodic_ghosts", stepping);
    EXPECT_FALSE(conserves(braked.section("physics.substrate", "type = \"friction\"\ncoefficient = 0.1")));
  }
  CaseText pushed = active();
  EXPECT_FALSE(conserves(pushed.section("physics.drive", "type = \"body_force\"\nforce = [0.1, 0.0]")));
}

TEST(KeptMomentum, GrowsByAForceFromOutside) {
  CaseText text = active();
  CaseRun run(text.section("physics.drive", "type = \"body_force\"\nforce = [0.1, 0.0]"));
  run.run_steps(64);
  EXPECT_NEAR(mean_velocity(run, 0), 1.0 + 0.1 * run.time(), 0.05 * 0.1 * run.time());
}

TEST(KeptMomentum, OfARestoredRunIsThatOfTheStart) {
  CaseRun run(active());
  run.run_steps(20);
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  CaseRun restored = CaseRun::unstarted(active());
  restored.stepper().restore(checkpoint);
  restored.run_steps(20);
  run.run_steps(20);
  EXPECT_EQ(state_of(restored), state_of(run));
  EXPECT_NEAR(mean_velocity(restored, 0), 1.0, 1e-14);
}

// As a branch finds it, whose run was pushed before.
TEST(KeptMomentum, IsThatOfTheCheckpointIfNoneWasKept) {
  CaseText text = active();
  text.section("physics.drive", "type = \"body_force\"\nforce = [0.1, 0.0]");
  CaseRun pushed(text);
  pushed.run_steps(40);
  Checkpoint checkpoint;
  pushed.stepper().save(checkpoint);
  const double mean = mean_velocity(pushed, 0);
  CaseRun branch = CaseRun::unstarted(active());
  branch.stepper().restore(checkpoint);
  branch.run_steps(24);
  EXPECT_NEAR(mean_velocity(branch, 0), mean, 1e-14);
}

}  // namespace
}  // namespace mesogen::test
