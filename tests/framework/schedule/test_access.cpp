// A pass is given what it declared, and told what it forgot.

#include <gtest/gtest.h>

#include <functional>

#include "graph_fixture.hpp"
#include "mesogen/plugin/context.hpp"
#include "particle_scene.hpp"
#include "schedule/executor.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

/// Runs one pass that declared to read "f" and write "out", and returns what it is told.
std::string refusal(const std::function<void(const PassContext&)>& body) {
  ParticleScene scene({}, lattice(20, 20, 0.05));
  scene.world().add_field("out", 1, false);
  scene.world().add_field("other", 1, false);
  Catalogue catalogue(2);
  PassList list;
  list.field("f", Rank::scalar).advanced_by("out");
  list.field("out", Rank::scalar);
  list.field("other", Rank::scalar);
  list.pass("work").reads({"f"}).reads_if_present({"absent"}).writes({"out"}).run(body);
  for (const FieldDeclaration& field : list.fields()) catalogue.add(field, "physics.mine");
  StepGraph graph(catalogue, {{"physics.mine", &list}}, {});
  DerivedFields derived(scene.world(), catalogue, {}, {});
  Executor executor(scene.world(), graph, derived);
  try {
    executor.run(Phase::rates, {});
  } catch (const Error& error) {
    return error.code() == ExitCode::plugin_refused ? error.what() : "another exit code";
  }
  return "no error";
}

TEST(Access, DeclaredFieldsAreGiven) {
  EXPECT_EQ(refusal([](const PassContext& context) {
              const auto f = context.read<double>("f");
              const auto out = context.write<double>("out");
              for (Index i = 0; i < context.count(); ++i) out(i) = f(i);
              EXPECT_EQ(context.count(), 400);
              EXPECT_FALSE(context.has("absent"));
              EXPECT_EQ((context.neighbours<double, 2>().particle_count), 400);
            }),
            "no error");
}

TEST(Access, UndeclaredReadIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<double>("other"); }),
            "pass 'physics.mine: work' reads the field 'other', which it did not declare: name it in the pass's reads, "
            "reads_neighbours or reads_if_present");
}

TEST(Access, UndeclaredWriteIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.write<double>("f"); }),
            "pass 'physics.mine: work' writes the field 'f', which it did not declare: name it in the pass's writes or "
            "accumulates");
}

TEST(Access, AbsentOptionalFieldIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<double>("absent"); }),
            "pass 'physics.mine: work' asks for the field 'absent', which this scene has not: ask has() first");
}

TEST(Access, WrongPrecisionIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<float>("f"); }),
            "pass 'physics.mine: work' asks for the field 'f' in another precision");
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.neighbours<float, 2>(); }),
            "'physics.mine: work' asks for neighbours of another precision or dimension");
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.neighbours<double, 3>(); }),
            "'physics.mine: work' asks for neighbours of another precision or dimension");
}

}  // namespace
