#include "schedule/step_graph.hpp"

#include <gtest/gtest.h>

#include "graph_fixture.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;
using Titles = std::vector<std::string>;

// Declared in the wrong order on purpose: what counts is who reads what.
TEST(StepGraph, OrdersWritersBeforeAddersBeforeReaders) {
  GraphFixture all;
  PassList& flow = all.plugin("physics.flow");
  flow.field("velocity", Rank::vector).predicted_by("acceleration");
  flow.field("acceleration", Rank::vector);
  flow.field("pressure", Rank::scalar);
  flow.pass("momentum").reads_neighbours({"pressure"}).accumulates({"acceleration"});
  flow.pass("state").writes({"pressure"});
  PassList& drive = all.plugin("physics.drive");
  drive.pass("drive").accumulates({"acceleration"});
  PassList& start = all.plugin("physics.start");
  start.pass("gravity").writes({"acceleration"});
  const StepGraph graph = all.graph();
  EXPECT_EQ(titles(graph), (Titles{"physics.flow: state", "physics.start: gravity", "physics.flow: momentum",
                                   "physics.drive: drive"}));
  EXPECT_TRUE(titles(graph, Phase::begin).empty());
}

TEST(StepGraph, AddersKeepTheOrderOfTheCase) {
  const auto order = [](const Titles& instances) {
    GraphFixture all;
    PassList& flow = all.plugin("flow");
    flow.field("u", Rank::vector).predicted_by("a");
    flow.field("a", Rank::vector);
    for (const std::string& instance : instances) all.plugin(instance).pass("force").accumulates({"a"});
    return titles(all.graph());
  };
  EXPECT_EQ(order({"b", "a"}), (Titles{"b: force", "a: force"}));
  EXPECT_EQ(order({"a", "b"}), (Titles{"a: force", "b: force"}));
}

TEST(StepGraph, ReaderOfAGradientWaitsForItsSource) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("u", Rank::vector).predicted_by("a");
  one.field("a", Rank::vector);
  one.field("stress", Rank::matrix);
  one.pass("force").reads({"stress_gradient"}).accumulates({"a"});
  one.pass("stress").reads({"u_gradient"}).writes({"stress"});
  const StepGraph graph = all.graph();
  EXPECT_EQ(titles(graph), (Titles{"one: stress", "one: force"}));
  EXPECT_EQ(graph.derived_for_integration(), (std::set<std::string>{"stress_gradient", "u_gradient"}));
}

TEST(StepGraph, StatesMayBeReadAndAdvancedInALoop) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("a", Rank::scalar).advanced_by("a_rate");
  one.field("b", Rank::scalar).advanced_by("b_rate");
  one.field("a_rate", Rank::scalar);
  one.field("b_rate", Rank::scalar);
  one.pass("first").reads({"b"}).writes({"a_rate"});
  one.pass("second").reads({"a"}).writes({"b_rate"});
  EXPECT_EQ(titles(all.graph()), (Titles{"one: first", "one: second"}));
}

TEST(StepGraph, PrunesWhatNobodyNeeds) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("q", Rank::scalar).advanced_by("q_rate");
  one.field("q_rate", Rank::scalar);
  one.field("seen", Rank::scalar);
  one.field("idle", Rank::scalar);
  one.pass("rate").reads({"q"}).writes({"q_rate"});
  one.pass("for the observer").reads({"q_laplacian"}).writes({"seen"});
  one.pass("for nobody").reads({"q_gradient"}).writes({"idle"});
  all.reader("observers.area", {"seen"});
  const StepGraph graph = all.graph();
  ASSERT_EQ(graph.passes().size(), 3U);
  EXPECT_TRUE(graph.passes()[0].for_integration);
  EXPECT_FALSE(graph.passes()[1].for_integration);
  EXPECT_TRUE(graph.passes()[1].for_observer[0]);
  EXPECT_FALSE(graph.passes()[1].pruned());
  EXPECT_TRUE(graph.passes()[2].pruned());
  EXPECT_EQ(titles(graph), (Titles{"one: rate", "one: for the observer"}));
  EXPECT_TRUE(graph.derived_for_integration().empty());
  EXPECT_EQ(graph.derived_for_reader(0), std::set<std::string>{"q_laplacian"});
  const std::string text = graph.text();
  EXPECT_NE(text.find("one: for the observer   (only when due: observers.area)"), std::string::npos) << text;
  EXPECT_NE(text.find("pruned: one: for nobody (nobody needs what it makes)"), std::string::npos) << text;
  EXPECT_NE(text.find("nothing moves: neighbours are found once"), std::string::npos) << text;
}

TEST(StepGraph, PrunesWhatAddsNothing) {
  for (const bool idle : {false, true}) {
    GraphFixture all;
    PassList& one = all.plugin("one");
    one.field("u", Rank::vector).predicted_by("a");
    one.field("a", Rank::vector);
    one.pass("pressure").accumulates({"a"});
    PassList& two = all.plugin("two");
    two.field("stress", Rank::matrix);
    two.pass("stress").reads({"u_gradient"}).writes({"stress"});
    two.pass("force").reads({"stress_gradient"}).accumulates({"a"}).idle_if(idle);
    const StepGraph graph = all.graph();
    EXPECT_EQ(titles(graph), idle ? Titles{"one: pressure"} : (Titles{"one: pressure", "two: stress", "two: force"}));
    EXPECT_EQ(graph.derived_for_integration().empty(), idle);
    const bool told =
        graph.text().find("pruned: two: force (with its parameters it adds nothing)") != std::string::npos;
    EXPECT_EQ(told, idle) << graph.text();
  }
}

TEST(StepGraph, FieldToWhichOnlyIdlePassesAddIsStillProvided) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("u", Rank::vector).predicted_by("a");
  one.field("a", Rank::vector);
  one.field("s", Rank::vector);
  one.flows({"u", "s"});
  one.pass("force").accumulates({"a"}).idle_if(true);
  one.pass("shift").accumulates({"s"}).idle_if(true);
  const StepGraph graph = all.graph();
  EXPECT_TRUE(titles(graph).empty());
  EXPECT_EQ(graph.transport().velocity, "u");
  EXPECT_EQ(graph.transport().shift, "");
}

TEST(StepGraph, OptionalReadsCountOnlyWhereTheSceneHasThem) {
  for (const bool flows : {false, true}) {
    GraphFixture all;
    PassList& one = all.plugin("nematic");
    one.field("q", Rank::scalar).advanced_by("q_rate");
    one.field("q_rate", Rank::scalar);
    one.pass("rate").reads_if_present({"u_gradient"}).writes({"q_rate"});
    if (flows) {
      PassList& flow = all.plugin("flow");
      flow.field("u", Rank::vector).predicted_by("a");
      flow.field("a", Rank::vector);
      flow.pass("momentum").accumulates({"a"});
    }
    EXPECT_EQ(all.graph().derived_for_integration().contains("u_gradient"), flows);
  }
}

TEST(StepGraph, ShiftThatNobodyAddsToMovesNothing) {
  for (const bool shifts : {false, true}) {
    GraphFixture all;
    PassList& flow = all.plugin("flow");
    flow.field("u", Rank::vector).predicted_by("a");
    flow.field("a", Rank::vector);
    flow.field("s", Rank::vector);
    flow.flows({"u", "s"});
    flow.pass("momentum").accumulates({"a"});
    if (shifts) flow.pass("shift").accumulates({"s"});
    const StepGraph graph = all.graph();
    EXPECT_EQ(graph.transport().velocity, "u");
    EXPECT_EQ(graph.transport().shift, shifts ? "s" : "");
  }
}

// What keeps particles fit for sums over neighbours runs where the integration takes such sums; a reader's do not
// count.
TEST(StepGraph, PassesBesidePairSumsRunWhereTheIntegrationSums) {
  for (const bool sums : {false, true}) {
    GraphFixture all;
    PassList& flow = all.plugin("flow");
    flow.field("u", Rank::vector).predicted_by("a");
    flow.field("a", Rank::vector);
    flow.field("s", Rank::vector);
    flow.flows({"u", "s"});
    flow.pass("mesh shift").accumulates({"s"});
    flow.pass("pair shift").accumulates({"s"}).beside_pair_sums();
    flow.pass("idle shift").accumulates({"s"}).beside_pair_sums().idle_if(true);
    Pass& force = all.plugin("other").pass("force").accumulates({"a"});
    if (sums) force.reads({"volume"});
    all.reader("observers.eye", {"volume", "s"});
    const StepGraph graph = all.graph();
    EXPECT_EQ(graph.sums_pairs(), sums);
    EXPECT_EQ(titles(graph), sums ? (Titles{"flow: mesh shift", "flow: pair shift", "other: force"})
                                  : (Titles{"flow: mesh shift", "other: force"}));
    EXPECT_EQ(
        graph.text().find("pruned: flow: pair shift (nobody else sums over neighbours in a step)") != std::string::npos,
        !sums)
        << graph.text();
  }
}

// The flow's own gradient takes the place of the framework's; readers get what is made for them at the end of the step.
TEST(StepGraph, AFieldOfADerivedNameIsThePluginsOwn) {
  GraphFixture all;
  PassList& flow = all.plugin("flow");
  flow.field("u", Rank::vector).advanced_by_passes();
  flow.field("u_gradient", Rank::matrix);
  flow.field("q", Rank::scalar).advanced_by("q_rate");
  flow.field("q_rate", Rank::scalar);
  flow.pass("predict", Phase::begin).reads({"u"}).writes({"u", "u_gradient"});
  flow.pass("solve").advances_what_is_kept();
  flow.pass("rate").reads({"u_gradient"}).writes({"q_rate"});
  flow.pass("arrive", Phase::end).writes({"u"});
  flow.pass("gradient for readers", Phase::observe).reads({"u"}).writes({"u_gradient"});
  flow.flows({"u", ""});
  all.reader("observers.eye", {"u_gradient"});
  const StepGraph graph = all.graph();
  EXPECT_TRUE(graph.derived_for_integration().empty());
  EXPECT_TRUE(graph.derived_for_reader(0).empty());
  EXPECT_FALSE(graph.sums_pairs());
  EXPECT_EQ(titles(graph, Phase::begin), Titles{"flow: predict"});
  EXPECT_EQ(titles(graph), (Titles{"flow: solve", "flow: rate"}));
  EXPECT_EQ(titles(graph, Phase::end), Titles{"flow: arrive"});
  EXPECT_EQ(titles(graph, Phase::observe), Titles{"flow: gradient for readers"});
  for (const ScheduledPass& scheduled : graph.passes()) {
    const bool for_readers = scheduled.pass.phase == Phase::observe;
    EXPECT_EQ(scheduled.for_integration, !for_readers) << scheduled.title();
    EXPECT_EQ(scheduled.for_observer[0],
              for_readers || scheduled.pass.name == "predict" || scheduled.pass.name == "arrive")
        << scheduled.title();
  }
  EXPECT_NE(graph.text().find("phase observe\n   1. flow: gradient for readers   (only when due: observers.eye)"),
            std::string::npos)
      << graph.text();
}

// What a plugin advances is advanced at every step, whether or not somebody reads it.
TEST(StepGraph, PassesThatAdvanceAFieldAlwaysRun) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("memory", Rank::scalar).advanced_by_passes();
  one.pass("remember").reads({"memory"}).writes({"memory"});
  EXPECT_EQ(titles(all.graph()), Titles{"one: remember"});
}

TEST(StepGraph, WhatIsMadeForReadersIsNotMadeWithoutThem) {
  GraphFixture all;
  PassList& flow = all.plugin("flow");
  flow.field("u", Rank::vector).advanced_by_passes();
  flow.field("seen", Rank::scalar);
  flow.pass("move", Phase::end).writes({"u"});
  flow.pass("look", Phase::observe).reads({"u"}).writes({"seen"});
  flow.flows({"u", ""});
  EXPECT_TRUE(titles(all.graph(), Phase::observe).empty());
}

}  // namespace
