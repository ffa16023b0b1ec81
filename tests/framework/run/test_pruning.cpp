// No more model than a scene needs: what runs, and how often, by the counters that `mesogen run --profile` shows.

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "case_run.hpp"
#include "run/marks_of.hpp"
#include "run/observation.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr int steps = 7;

CaseText nematic_scene() {
  CaseText text(2.0, 16);
  text.modes("director", "[[1, 0, 0.4, 0.3], [0, 1, 0.3, 1.1]]").nematic(0.4, 0.7, 0.02);
  return text;
}

CaseText full_scene(double activity = 0.5) { return nematic_scene().flow(0.1).active(activity); }

using Counters = std::map<std::string, std::int64_t>;

Counters counters(CaseRun& run) {
  Counters all;
  for (const auto& share : run.stepper().shares()) all[share.title] = share.runs;
  all["neighbour builds"] = run.state().neighbourhood.sortings();
  all["positions"] = static_cast<std::int64_t>(run.state().neighbourhood.version());
  return all;
}

bool mentions(const Counters& counters, const std::string& part) {
  for (const auto& [title, runs] : counters)
    if (title.find(part) != std::string::npos) return true;
  return false;
}

TEST(Pruning, WithoutFlowNeighboursAreBuiltOnceAndNothingMoves) {
  CaseRun run(nematic_scene());
  const auto x = run.path(0);
  run.run_steps(steps);
  const Counters found = counters(run);
  EXPECT_EQ(found, (Counters{{"neighbour builds", 1},
                             {"positions", 1},
                             {"framework: volume", 1},
                             {"framework: weights of pairs", 1},
                             {"framework: order_tensor_laplacian", 1 + steps},   // at the start, then at each midpoint
                             {"framework: values beyond the faces", 2 + steps},  // the volume, then Q each time
                             {"framework: neighbours, sorting", 1},
                             {"framework: integration", 3 * steps},  // to the midpoint, on, and what it found
                             {"framework: guard", 2 * steps},        // looks, and reads what it found
                             {"physics.nematic: rate of the order tensor", 1 + steps},
                             {"physics.nematic: diffusion of order_tensor", 1 + steps}}));
  EXPECT_EQ(run.path(0), x);
  // Nothing that only a flow, or nobody, needs takes memory.
  for (const auto& [name, field] : run.state().fields.all())
    EXPECT_TRUE(name == "volume" || name.starts_with("order_tensor")) << name;
}

TEST(Pruning, WithoutFlowOnWallsWeightsAreFoundOnceToo) {
  CaseRun run(nematic_scene().section("domain",
                                      "size = [2.0, 2.0]\nboundary = { type = \"walls\", axes = [\"y\"], anchoring = "
                                      "\"planar\" }"));
  run.run_steps(steps);
  const Counters found = counters(run);
  EXPECT_EQ(found.at("neighbour builds"), 1);
  EXPECT_EQ(found.at("framework: weights of pairs"), 1);
}

TEST(Pruning, WhereThereIsFlowEverythingRunsOnceAStep) {
  CaseRun run(full_scene());
  run.run_steps(steps);
  const Counters found = counters(run);
  EXPECT_EQ(found.at("positions"), 1 + steps);
  EXPECT_EQ(found.at("physics.activity: active stress"), 1 + steps);
  EXPECT_EQ(found.at("framework: volume"), 1 + steps);
  EXPECT_EQ(found.at("framework: correction, order_tensor_gradient, order_tensor_laplacian, velocity_gradient, "
                     "velocity_laplacian"),
            1 + steps);
  EXPECT_FALSE(mentions(found, "weights of"));
}

// Left out of the case, or with an activity of zero: nobody needs the gradient of Q, but for a shift.
TEST(Pruning, WithoutActivityThereIsNoStressPass) {
  for (const bool zero : {false, true}) {
    CaseRun run(zero ? full_scene(0.0) : nematic_scene().flow(0.1), {"physics.flow.shift = 0.0"});
    run.run_steps(steps);
    const Counters found = counters(run);
    EXPECT_FALSE(mentions(found, "active stress"));
    EXPECT_FALSE(mentions(found, "order_tensor_gradient"));
    EXPECT_EQ(found.at("framework: correction, order_tensor_laplacian, velocity_gradient, velocity_laplacian"),
              1 + steps);
  }
}

TEST(Pruning, ForcesOfZeroRunNoPass) {
  CaseRun run(full_scene()
                  .section("physics.substrate", "type = \"friction\"\ncoefficient = 0.0")
                  .section("physics.drive", "type = \"body_force\"\nforce = [0.0, 0.0]"));
  run.run_steps(steps);
  EXPECT_FALSE(mentions(counters(run), "physics.substrate"));
  EXPECT_FALSE(mentions(counters(run), "physics.drive"));
}

/// Steps as a run takes them, with its observers; how often each pass ran.
Counters observed(CaseRun& run, int count) {
  Observation observation(run.stepper());
  observation.start();
  const Counters before = counters(run);
  for (int n = 0; n < count; ++n) {
    const Stepper::Step step = run.stepper().next_step(1e6);
    const auto due =
        marks_of(run.setup()).due(run.stepper().arrival(), {step.arrival, step.seconds}, run.state().step + 1);
    run.stepper().advance(step, due);
    observation.sample(due, [](const std::string&, const Sample&) {});
  }
  Counters after = counters(run);
  for (auto& [title, runs] : after) runs -= before.at(title);
  return after;
}

// The elastic energy is for readers alone; the gradient of Q is read only where nobody makes that energy.
TEST(Pruning, WhatOnlyAnObserverNeedsRunsOnlyForItsSamples) {
  CaseRun run(nematic_scene()
                  .flow(0.1, "shift = 0.0")
                  .section("observers.nematic", "type = \"nematic_statistics\"\nevery = 10"));
  const Counters found = observed(run, 35);
  EXPECT_EQ(found.at("physics.nematic: elastic energy, for readers"), 3);
  EXPECT_FALSE(mentions(found, "order_tensor_gradient"));
  EXPECT_GE(found.at("framework: correction, order_tensor_laplacian, velocity_gradient, velocity_laplacian"), 35);
}

TEST(Pruning, WhatSeveralObserversReadIsMadeOnceASample) {
  CaseText scene =
      nematic_scene().section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05");
  for (const std::string name : {"a", "b"})
    for (const std::string type : {"nematic_statistics", "flow_statistics", "lyapunov"})
      scene.section("observers." + type + "_" + name, "type = \"" + type + "\"\nevery = 10");
  CaseRun run(scene);
  const Counters found = observed(run, 35);
  EXPECT_EQ(found.at("physics.nematic: elastic energy, for readers"), 3);
  EXPECT_EQ(found.at("physics.flow: velocity gradient, for readers"), 3);
  EXPECT_EQ(found.at("framework: volume"), 3);
  EXPECT_FALSE(mentions(found, "derivatives of the order tensor, for readers"));
}

TEST(Pruning, WithoutFlowSamplesComputeNothingElseAnew) {
  CaseRun run(nematic_scene().section("observers.nematic", "type = \"nematic_statistics\"\nevery = 10"));
  const Counters found = observed(run, 35);
  EXPECT_EQ(found.at("physics.nematic: elastic energy, for readers"), 3);
  EXPECT_EQ(found.at("framework: order_tensor_laplacian"), 35);  // once a step
  EXPECT_EQ(found.at("framework: volume"), 0);
  EXPECT_EQ(found.at("framework: weights of pairs"), 0);
  EXPECT_EQ(found.at("neighbour builds"), 0);
}

// A pass of a plugin that only the output reads: it runs for its frames alone.
TEST(Pruning, PassThatOnlyTheOutputNeedsRunsOnlyForFrames) {
  CaseText text = nematic_scene().flow(0.1);
  text.section("output", "fields = [\"molecular_field\"]\ninterval = 1e9");
  CaseRun run(text);
  const Counters found = observed(run, 20);
  EXPECT_EQ(found.at("physics.nematic: molecular field"), 0);
  EXPECT_EQ(found.at("physics.nematic: rate of the order tensor"), 20);
}

// exp(-Gamma K k^2 t) of a small wave of the director, by weights as by pair sums.
TEST(Pruning, WithoutFlowAWaveDecaysAsItShould) {
  CaseText text(2.0, 40);
  text.kernel("quintic", "plain").modes("director", "[[1, 0, 0.01, 0.0]]").nematic(0.4, 0.7, 0.02);
  CaseRun run(text);
  const double before = wave_of(run, run.field("order_tensor", 1), 1, 0).cosine;
  run.run_to(5.0);
  const double k = 2.0 * std::numbers::pi / 2.0;
  EXPECT_NEAR(wave_of(run, run.field("order_tensor", 1), 1, 0).cosine / before, std::exp(-0.4 * 0.02 * k * k * 5.0),
              2e-3);
}

}  // namespace
