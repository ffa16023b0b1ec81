// A pass is given what it declared, and told what it forgot.

#include <gtest/gtest.h>
#include <omp.h>

#include <functional>
#include <new>
#include <stdexcept>

#include "graph_fixture.hpp"
#include "mesogen/plugin/context.hpp"
#include "particle_scene.hpp"
#include "schedule/executor.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

using Declare = std::function<void(Pass&)>;

/// Runs one pass that declared to read "f", to write "out", and what `declare` adds.
void run_pass(const std::function<void(const PassContext&)>& body, const Declare& declare = {}, bool moved = false,
              Phase phase = Phase::rates) {
  ParticleScene scene({}, lattice(20, 20, 0.05));
  if (moved) scene.state().order.mark_moved();
  scene.state().add_field("out", 1, false);
  scene.state().add_field("other", 1, false);
  Catalogue catalogue(2);
  PassList list;
  list.field("f", Rank::scalar).advanced_by("out");
  list.field("out", Rank::scalar);
  list.field("other", Rank::scalar);
  Pass& pass = list.pass("work", phase).reads({"f"}).reads_if_present({"absent"}).writes({"out"}).run(body);
  if (declare) declare(pass);
  for (const FieldDeclaration& field : list.fields()) catalogue.add(field, "physics.mine");
  // At the end of a step it is somebody's who reads what it made, at the others the integration's.
  const bool for_reader = phase == Phase::end;
  StepGraph graph(catalogue, {{"physics.mine", &list, "mine"}},
                  for_reader ? std::vector<Reader>{{"observers.mine", {"out"}}} : std::vector<Reader>{});
  DerivedFields derived(scene.state(), catalogue, {}, {}, DerivedFields::Form{});
  Executor executor(scene.state(), graph, derived);
  executor.run(phase, std::vector<bool>(for_reader ? 1 : 0, true));
}

/// What it is told.
std::string refusal(const std::function<void(const PassContext&)>& body, const Declare& declare = {},
                    bool moved = false, Phase phase = Phase::rates) {
  try {
    run_pass(body, declare, moved, phase);
  } catch (const Error& error) {
    return error.code() == ExitCode::plugin_refused ? error.what() : "another exit code";
  }
  return "no error";
}

const std::string where = "physics.mine (plugin \"mine\"), pass \"work\" at step 0, t = 0 s: ";

TEST(Access, DeclaredFieldsAreGiven) {
  EXPECT_EQ(refusal([](const PassContext& context) {
              const auto f = context.read<double>("f");
              const auto out = context.write<double>("out");
              for (Index i = 0; i < context.count(); ++i) out(i) = f(i);
              EXPECT_EQ(context.count(), 400);
              EXPECT_FALSE(context.has("absent"));
            }),
            "no error");
}

TEST(Access, UndeclaredReadIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<double>("other"); }),
            where +
                "it reads the field 'other', which it did not declare: name it in the pass's reads, "
                "reads_neighbours or reads_if_present");
}

TEST(Access, UndeclaredWriteIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.write<double>("f"); }),
            where +
                "it writes the field 'f', which it did not declare: name it in the pass's writes or "
                "accumulates");
}

TEST(Access, AbsentOptionalFieldIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<double>("absent"); }),
            where + "it asks for the field 'absent', which this scene has not: ask has() first");
}

TEST(Access, WrongPrecisionIsRefused) {
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.read<float>("f"); }),
            where + "it asks for the field 'f' in another precision: take that of its class, Real");
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.neighbours<float, 2>(); }),
            where + "it asks for neighbours of another precision or dimension: take those of its class, Real and Dim");
  EXPECT_EQ(refusal([](const PassContext& context) { (void)context.neighbours<double, 3>(); }),
            where + "it asks for neighbours of another precision or dimension: take those of its class, Real and Dim");
}

// Neighbours are found anew, and copies beyond the boundary refreshed, for passes that declare to read there, whatever
// the phase and whoever needs the pass. Others are refused even where neighbours happen to be up to date.
TEST(Access, NeighboursAreGivenToWhoDeclaresToReadThere) {
  const auto ask = [](const PassContext& context) { EXPECT_EQ((context.neighbours<double, 2>().particle_count), 400); };
  const auto declare = [](Pass& pass) { pass.reads_neighbours({"f"}); };
  for (const bool moved : {false, true})
    for (const Phase phase : {Phase::rates, Phase::end}) {
      EXPECT_EQ(refusal(ask, declare, moved, phase), "no error");
      EXPECT_EQ(refusal(ask, {}, moved, phase),
                where +
                    "it asks for neighbours, and declares none that it reads: name the fields that it reads at them in "
                    "the pass's reads_neighbours");
    }
}

TEST(Access, WhatAPassThrowsIsToldOn) {
  const auto told = [](const std::function<void(const PassContext&)>& body, ExitCode code) {
    try {
      run_pass(body);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string failed = where.substr(0, where.size() - 2) + " failed: ";
  EXPECT_EQ(told([](const PassContext&) { throw std::out_of_range("no such row"); }, ExitCode::run_failed),
            failed + "no such row");
  EXPECT_EQ(told([](const PassContext&) { throw 42; }, ExitCode::run_failed),
            failed + "it threw something that is no std::exception");
  EXPECT_EQ(
      told([](const PassContext&) { throw Error(ExitCode::bad_case, "take a finer lattice"); }, ExitCode::bad_case),
      where + "take a finer lattice");
  EXPECT_THROW(run_pass([](const PassContext&) { throw std::bad_alloc(); }), std::bad_alloc);
}

// An exception must not leave a parallel region; for_each and pair_sum carry it out.
TEST(Access, WhatAParticleThrowsLeavesTheParallelLoop) {
  omp_set_num_threads(3);
  EXPECT_THROW(exec::for_each({}, 1000,
                              [](Index i) {
                                if (i % 7 == 3) throw std::out_of_range("i");
                              }),
               std::out_of_range);
  EXPECT_THROW(exec::for_each({}, 1000,
                              [](Index i) {
                                if (i == 999) throw 42;
                              }),
               int);
}

}  // namespace
