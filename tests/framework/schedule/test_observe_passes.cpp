// What passes make for readers is made when one asks, and only if it is out of date.

#include <gtest/gtest.h>

#include "graph_fixture.hpp"
#include "mesogen/plugin/context.hpp"
#include "particle_scene.hpp"
#include "schedule/executor.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

TEST(ObservePasses, RunWhenAReaderAsksAndSomethingHasChanged) {
  ParticleScene scene({}, lattice(20, 20, 0.05));
  State& state = scene.state();
  for (const char* const name : {"f_rate", "seen"}) state.add_field(name, 1, false);
  Catalogue catalogue(2);
  PassList list;
  list.field("f", Rank::scalar).advanced_by("f_rate");
  list.field("f_rate", Rank::scalar);
  list.field("seen", Rank::scalar);
  const auto fill = [](double value) {
    return [value](const PassContext& context) {
      const auto seen = context.write<double>("seen");
      for (Index i = 0; i < context.count(); ++i) seen(i) = value;
    };
  };
  list.pass("in the step").reads({"f"}).writes({"seen"}).run(fill(1.0));
  list.pass("rate").reads({"seen"}).writes({"f_rate"}).run([](const PassContext&) {});
  list.pass("for readers", Phase::observe).reads({"f"}).writes({"seen"}).run(fill(2.0));
  for (const FieldDeclaration& field : list.fields()) catalogue.add(field, "physics.mine");
  StepGraph graph(catalogue, {{"physics.mine", &list, "mine"}}, {{"observers.eye", {"seen"}}});
  DerivedFields derived(state, catalogue, {}, {{}}, DerivedFields::Form{});
  Executor executor(state, graph, derived);
  const auto runs = [&] { return graph.passes().back().counter.runs; };
  const std::vector<std::string> seen{"seen"};

  executor.run(Phase::rates, {true});
  EXPECT_EQ(state.fields.at("seen").value(0, 7), 1.0);
  executor.prepare(seen);
  executor.prepare(seen);
  EXPECT_EQ(state.fields.at("seen").value(0, 7), 2.0);
  EXPECT_EQ(runs(), 1);
  state.order.mark_moved();
  executor.prepare(seen);
  EXPECT_EQ(runs(), 2);
  ++state.fields.at("f").version;
  executor.prepare(seen);
  EXPECT_EQ(runs(), 3);
  // The step has written over it.
  executor.run(Phase::rates, {false});
  EXPECT_EQ(state.fields.at("seen").value(0, 7), 1.0);
  executor.prepare(seen);
  EXPECT_EQ(state.fields.at("seen").value(0, 7), 2.0);
  EXPECT_EQ(runs(), 4);
}

}  // namespace
