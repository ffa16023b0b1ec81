#include <gtest/gtest.h>

#include "graph_fixture.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

TEST(StepGraphErrors, TwoWritersAreNamed) {
  GraphFixture all;
  PassList& one = all.plugin("physics.one");
  one.field("stress", Rank::matrix);
  one.pass("stress").writes({"stress"});
  all.plugin("physics.two").pass("other stress").writes({"stress"});
  EXPECT_EQ(all.refusal(),
            "field 'stress' has two writers: 'physics.one: stress' and 'physics.two: other stress'. Remove one of them "
            "from the case, or let both accumulate");
}

TEST(StepGraphErrors, WritersInDifferentPhasesAreNoConflict) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("stress", Rank::matrix);
  one.pass("early", Phase::begin).writes({"stress"});
  one.pass("late", Phase::end).writes({"stress"});
  EXPECT_EQ(all.refusal(), "no error");
}

TEST(StepGraphErrors, IdlePassThatWritesIsRefused) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("stress", Rank::matrix);
  one.pass("stress").writes({"stress"}).idle_if(true);
  EXPECT_EQ(all.refusal(ExitCode::plugin_refused),
            "'one: stress' is idle and writes 'stress': idle_if is for passes that only add to fields");
}

TEST(StepGraphErrors, PassBesidePairSumsThatWritesIsRefused) {
  GraphFixture all;
  PassList& one = all.plugin("one");
  one.field("stress", Rank::matrix);
  one.pass("stress").writes({"stress"}).beside_pair_sums();
  EXPECT_EQ(all.refusal(ExitCode::plugin_refused),
            "'one: stress' runs beside pair sums and writes 'stress': beside_pair_sums is for passes that only add to "
            "fields");
}

TEST(StepGraphErrors, TwoPluginsWithOneFieldAreNamed) {
  GraphFixture all;
  all.plugin("physics.one").field("velocity", Rank::vector);
  all.plugin("physics.two").field("velocity", Rank::vector);
  EXPECT_EQ(all.refusal(),
            "field 'velocity' is introduced by both physics.one and physics.two: remove one of them from the case");
}

TEST(StepGraphErrors, TwoFlowsAreRefused) {
  GraphFixture all;
  PassList& one = all.plugin("physics.one");
  one.field("u", Rank::vector).predicted_by("a");
  one.field("a", Rank::vector);
  one.pass("force").accumulates({"a"});
  one.flows({"u", ""});
  PassList& two = all.plugin("physics.two");
  two.flows({"u", ""});
  EXPECT_EQ(all.refusal(), "two physics plugins move the particles, the second is physics.two: a case has one flow");
}

TEST(StepGraphErrors, FieldThatNobodyWritesIsTracedBack) {
  GraphFixture all;
  all.plugin("physics.nematic").field("order_tensor", Rank::order_tensor);
  PassList& one = all.plugin("physics.active");
  one.field("u", Rank::vector).predicted_by("a");
  one.field("a", Rank::vector);
  one.pass("active stress").reads({"order_tensor_gradient"}).accumulates({"a"});
  EXPECT_EQ(all.refusal(),
            "nobody in this case provides the field\n"
            "  'order_tensor', wanted by 'order_tensor_gradient'\n"
            "  'order_tensor_gradient', wanted by 'physics.active: active stress'\n"
            "  'a', wanted by the time integration\n"
            "Add a physics plugin that writes it (`mesogen plugin list`), or remove what needs it");
}

TEST(StepGraphErrors, PluginThatCanDoNothingIsNamed) {
  const auto refusal = [](const auto& declare) {
    GraphFixture all;
    declare(all.plugin("physics.mine").pass("work"));
    return all.refusal();
  };
  const std::string mend =
      ", which no plugin of this case introduces. Add one that does (`mesogen plugin info` tells), or remove "
      "'physics.mine'";
  EXPECT_EQ(refusal([](Pass& pass) { pass.reads({"q_gradient"}); }), "'physics.mine: work' reads 'q_gradient'" + mend);
  EXPECT_EQ(refusal([](Pass& pass) { pass.reads_neighbours({"q"}); }), "'physics.mine: work' reads 'q'" + mend);
  EXPECT_EQ(refusal([](Pass& pass) { pass.writes({"q"}); }), "'physics.mine: work' writes 'q'" + mend);
  EXPECT_EQ(refusal([](Pass& pass) { pass.accumulates({"a"}); }), "'physics.mine: work' adds to 'a'" + mend);
}

TEST(StepGraphErrors, MisspeltFieldsAreToldTheNearest) {
  GraphFixture all;
  PassList& flow = all.plugin("physics.flow");
  flow.field("velocity", Rank::vector).advanced_by("acceleration");
  flow.field("acceleration", Rank::vector);
  flow.pass("push").accumulates({"acceleration"});
  all.plugin("physics.mine").pass("work").reads({"velocty"}).accumulates({"acceleration"});
  EXPECT_EQ(all.refusal(),
            "'physics.mine: work' reads 'velocty', which no plugin of this case introduces; did you mean \"velocity\"? "
            "Add one that does (`mesogen plugin info` tells), or remove 'physics.mine'");
}

TEST(StepGraphErrors, StatesAreNotWritten) {
  GraphFixture all;
  PassList& one = all.plugin("physics.one");
  one.field("q", Rank::scalar).advanced_by("q_rate");
  one.field("q_rate", Rank::scalar);
  one.pass("rate").writes({"q_rate"});
  one.pass("reset").writes({"q"});
  EXPECT_EQ(all.refusal(ExitCode::plugin_refused),
            "'physics.one: reset' writes 'q', which keeps its value from step to step: add to its rate of change "
            "instead");
}

TEST(StepGraphErrors, ReaderWithoutItsFieldIsNamed) {
  GraphFixture all;
  all.reader("observers.flow", {"velocity"});
  EXPECT_EQ(all.refusal(),
            "nobody in this case provides the field\n"
            "  'velocity', wanted by observers.flow\n"
            "Add a physics plugin that writes it (`mesogen plugin list`), or remove what needs it");
}

TEST(StepGraphErrors, CycleIsShownEdgeByEdge) {
  GraphFixture all;
  PassList& one = all.plugin("physics.one");
  one.field("q", Rank::scalar).advanced_by("q_rate");
  one.field("q_rate", Rank::scalar);
  one.field("a", Rank::scalar);
  one.field("b", Rank::scalar);
  one.pass("outside").writes({"q_rate"}).reads({"a"});
  one.pass("a from b").reads({"b"}).writes({"a"});
  all.plugin("physics.two").pass("b from a").reads_neighbours({"a_gradient"}).writes({"b"});
  EXPECT_EQ(all.refusal(),
            "these passes wait for each other:\n"
            "  'physics.one: a from b' needs 'b' of 'physics.two: b from a'\n"
            "  'physics.two: b from a' needs 'a' of 'physics.one: a from b'\n"
            "Remove one of the plugins from the case");
}

// Whoever looks must change nothing.
TEST(StepGraphErrors, WhatIsMadeForReadersIsNeitherAddedToNorLasts) {
  GraphFixture adds;
  PassList& one = adds.plugin("one");
  one.field("seen", Rank::scalar);
  one.pass("look", Phase::observe).accumulates({"seen"});
  EXPECT_EQ(adds.refusal(ExitCode::plugin_refused),
            "'one: look' adds to 'seen' for readers: a pass of Phase::observe writes what it makes");
  GraphFixture lasts;
  PassList& flow = lasts.plugin("flow");
  flow.field("u", Rank::vector).advanced_by_passes();
  flow.pass("move", Phase::end).writes({"u"});
  flow.pass("look", Phase::observe).writes({"u"});
  EXPECT_EQ(lasts.refusal(ExitCode::plugin_refused),
            "'flow: look' writes 'u' for readers, which keeps its value from step to step: an observation must not "
            "change the run");
}

TEST(StepGraphErrors, InitialConditionSetsWhatAPassMakes) {
  GraphFixture fixture;
  PassList& flow = fixture.plugin("flow");
  flow.field("pressure", Rank::scalar);
  flow.pass("state").writes({"pressure"});
  fixture.initial("squeezed", "pressure");
  EXPECT_EQ(fixture.refusal(),
            "[squeezed] sets 'pressure', which 'flow: state' makes at each step: remove that section");
}

TEST(StepGraphErrors, TwoInitialConditionsSetOneField) {
  GraphFixture fixture;
  fixture.initial("hot", "heat");
  fixture.initial("cold", "heat");
  EXPECT_EQ(fixture.refusal(), "field 'heat' is set by [hot] and by [cold]: remove one of the two sections");
}

TEST(StepGraphErrors, PositionIsNoField) {
  GraphFixture fixture;
  PassList& trap = fixture.plugin("trap");
  trap.field("acceleration", Rank::vector);
  trap.pass("pull").reads({"position"}).accumulates({"acceleration"});
  EXPECT_EQ(fixture.refusal(ExitCode::plugin_refused),
            "'trap: pull' reads 'position', which is no field: a pass takes coordinates from context.position(axis), "
            "without naming them");
}

}  // namespace
