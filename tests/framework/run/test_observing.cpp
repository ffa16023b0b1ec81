// Observing changes nothing: the same bits whoever looks, and however often.

#include <gtest/gtest.h>

#include "active_scene.hpp"
#include "run/observation.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr const char* observers[] = {"flow_statistics", "nematic_statistics", "defects", "mixing", "pathlines"};

/// The whole state of a run, order of storage included, after steps of which every n-th is observed; 0: none is.
Checkpoint observed_every(const CaseText& scene, int every, int steps) {
  CaseRun run(scene);
  Observation observation(run.stepper());
  observation.start();
  for (int n = 1; n <= steps; ++n) {
    const std::vector<bool> due(run.stepper().setup().observers.size() + 1, every > 0 && n % every == 0);
    run.stepper().advance(run.stepper().next_step(1e6), due);
    observation.sample(due, [](const std::string&, const Sample&) {});
    if (due.back()) (void)observation.frame();
  }
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  EXPECT_GT(run.state().neighbourhood.sortings(), 1);
  return checkpoint;
}

void expect_no_trace(CaseText scene, int steps) {
  for (const std::string name : observers) scene.section("observers." + name, "type = \"" + name + "\"\nevery = 1");
  scene.section("output", "fields = [\"velocity\", \"order_tensor\", \"velocity_gradient\", \"volume\"]");
  scene.section("colour", "type = \"quarter\"");
  const Checkpoint unobserved = observed_every(scene, 0, steps);
  for (const int every : {1, 2, 3, 7, 40}) {
    const Checkpoint observed = observed_every(scene, every, steps);
    EXPECT_EQ(observed.numbers, unobserved.numbers) << "observed every " << every << " steps";
    EXPECT_EQ(observed.integers, unobserved.integers) << "observed every " << every << " steps";
    EXPECT_EQ(observed.time, unobserved.time);
  }
}

class Observing : public testing::TestWithParam<const char*> {};

TEST_P(Observing, LeavesNoTraceInWeaklyCompressibleFlow) {
  expect_no_trace(active_scene("single", GetParam()), 100);
  expect_no_trace(active_scene("double", GetParam()), 40);
}

INSTANTIATE_TEST_SUITE_P(All, Observing, testing::Values("periodic_ghosts", "periodic_wrap", "walls"),
                         [](const auto& set) { return std::string(set.param); });

// One pass finds the weights of stages beside gradients, also where a reader asks for these first.
TEST(Observing, LeavesNoTraceInStabilisedSteps) {
  for (const std::string boundary : {"periodic_ghosts", "walls"})
    expect_no_trace(active_scene("double", boundary, "stabilised"), 25);
}

CaseText mesh_scene(const std::string& boundary, const std::string& precision) {
  return active_scene(precision, boundary)
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05");
}

// Nothing sums over neighbours in a step: particles are stored anew now and then, and have strayed when somebody looks.
TEST(Observing, LeavesNoTraceInIncompressibleFlow) {
  for (const std::string boundary : {"periodic_ghosts", "periodic_wrap"}) {
    const auto scene = [&](const std::string& precision) {
      return mesh_scene(boundary, precision).section("physics.elasticity", "type = \"friction\"\ncoefficient = 0.1");
    };
    expect_no_trace(scene("double"), 60);
    expect_no_trace(scene("single"), 60);
  }
}

// Forces that are sums over neighbours; in so slow a flow particles are not sorted at every step.
TEST(Observing, LeavesNoTraceInIncompressibleFlowWithNeighbourSums) {
  expect_no_trace(mesh_scene("periodic_wrap", "double")
                      .section("velocity", "type = \"uniform\"\nvalue = [0.1, -0.06]")
                      .section("physics.activity", "type = \"active_stress\"\nactivity = 0.5\nform = \"conservative\""),
                  60);
}

}  // namespace
