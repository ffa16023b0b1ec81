// A restored run takes the steps of the unbroken one, however its velocity is advanced.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "case_text.hpp"
#include "mesogen/exec/for_each.hpp"
#include "run/setup.hpp"
#include "run/stepper.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {
namespace {

using Declare = std::function<void(FieldDeclaration& velocity)>;

/// A fluid that is pushed to and fro, more and more, so that the acceleration binds the step and not the speed.
class Pushed {
 public:
  explicit Pushed(const Declare& advance) {
    const SetupAdditions additions{.scene = {}, .fields = [&](Setup& setup) { push(setup, advance); }, .readers = {}};
    Problems problems;
    CaseText text(1.0, 10);
    text.section("physics.drive", "type = \"body_force\"\nforce = [0.0, 0.0]");
    setup_ = set_up(read_case_text(text.text(), "test.toml", {}, problems), built_plugins(), problems, additions);
    stepper_ = std::make_unique<Stepper>(*setup_);
    stepper_->start();
  }

  Stepper& stepper() { return *stepper_; }

  std::vector<double> steps(int count) {
    std::vector<double> sizes;
    for (int n = 0; n < count; ++n) {
      const Stepper::Step step = stepper_->next_step(1e6);
      EXPECT_EQ(step.limit, "acceleration: 0.25 sqrt(h / |a|)");
      sizes.push_back(step.seconds);
      stepper_->advance(step, {false});
    }
    return sizes;
  }

 private:
  static void push(Setup& setup, const Declare& advance) {
    setup.physics.emplace_back();
    Setup::PhysicsMember& member = setup.physics.back();
    member.instance = "physics.push";
    member.type = "push";
    advance(member.passes.field("velocity", Rank::vector));
    member.passes.field("acceleration", Rank::vector);
    member.passes.field("density", Rank::scalar);  // that the idle force names
    member.passes.pass("density").writes({"density"}).run([](const PassContext&) {});
    member.passes.flows({.velocity = "velocity", .shift = {}});
    member.passes.pass("push").accumulates({"acceleration"}).run([](const PassContext& context) {
      const auto acceleration = context.write<double>("acceleration");
      const double* const x = context.position(0);
      const double push = (context.step() % 2 == 0 ? 100.0 : -100.0) * (1.0 + 30.0 * context.time());
      exec::for_each(context.space(), context.count(),
                     [=](Index i) { acceleration(0, i) += push * (1.0 + std::sin(6.0 * x[i])); });
    });
    for (const FieldDeclaration& field : member.passes.fields()) setup.catalogue.add(field, member.instance);
  }

  std::unique_ptr<Setup> setup_;
  std::unique_ptr<Stepper> stepper_;
};

void expect_same_steps(const Declare& advance) {
  Pushed unbroken(advance);
  unbroken.steps(3);
  Checkpoint checkpoint;
  unbroken.stepper().save(checkpoint);
  Pushed restored(advance);
  restored.stepper().restore(checkpoint);
  const auto sizes = unbroken.steps(5);
  EXPECT_EQ(restored.steps(5), sizes);
  EXPECT_LT(sizes.back(), sizes.front());
}

TEST(RestoredSteps, AreThoseOfTheUnbrokenRun) {
  expect_same_steps([](FieldDeclaration& velocity) { velocity.predicted_by("acceleration"); });
  expect_same_steps([](FieldDeclaration& velocity) { velocity.advanced_by("acceleration"); });
}

}  // namespace
}  // namespace mesogen::test
