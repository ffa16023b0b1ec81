// Frames of a run on a device whose memory is apart, played by the host: taken while steps go on, they have the bits of
// the host, and nothing else comes to the host for them.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "../run/active_scene.hpp"
#include "counting_memory.hpp"
#include "emulated_device.hpp"
#include "run/observation.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

using Frames = std::map<std::string, std::vector<double>>;  // by step and field

CaseText scene(const std::string& precision, const std::string& boundary) {
  return active_scene(precision, boundary)
      .section("output", "fields = [\"velocity\", \"order_tensor\", \"velocity_gradient\", \"volume\"]");
}

/// Frames of every eighth step, filled some steps later. `take` takes one.
template <class Take>
Frames frames_of(const CaseText& text, const SetupAdditions& additions, Take&& take) {
  const auto setup = put_together(text, built_plugins(), additions);
  Stepper stepper(*setup);
  Observation observation(stepper);
  stepper.start();
  observation.start();
  Frames frames;
  for (int frame = 0; frame < 5; ++frame) {
    const std::string step = std::to_string(stepper.state().step) + " ";
    stepper.executor().prepare(setup->output_fields);
    TakenFrame taken = take(observation);
    for (int n = 0; n < 8; ++n) stepper.advance(stepper.next_step(1e6), std::vector<bool>(1, n == 7));
    taken.fill(taken.fields);
    for (const FrameField& field : taken.fields) frames[step + field.name] = field.values;
  }
  EXPECT_GT(stepper.state().neighbourhood.sortings(), 1);
  return frames;
}

TakenFrame taken_by(Observation& observation) { return observation.take_frame(); }

/// All values are there before a step is made.
TakenFrame filled_at_once(Observation& observation) {
  return {observation.frame(), [](std::vector<FrameField>&) {}};
}

void expect_same(const Frames& found, const Frames& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, values] : expected) EXPECT_TRUE(found.at(name) == values) << name;
}

class EmulatedFrames : public testing::TestWithParam<const char*> {};

TEST_P(EmulatedFrames, AreThoseOfTheHost) {
  for (const std::string precision : {"single", "double"}) {
    const CaseText text = scene(precision, GetParam());
    const Frames host = frames_of(text, {}, filled_at_once);
    EXPECT_EQ(host.size(), 5U * 6U);
    expect_same(frames_of(text, {}, taken_by), host);
    for (const bool full : {false, true})
      for (const bool on_device : {true, false}) {
        CountingMemory memory;
        const EmulatedDevice device(memory);
        const auto additions = device.additions([on_device](const std::string&) { return on_device; });
        expect_same(frames_of(text, additions,
                              [&](Observation& observation) {
                                memory.full = full;
                                TakenFrame taken = taken_by(observation);
                                memory.full = false;
                                return taken;
                              }),
                    host);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EmulatedFrames, testing::Values("periodic_ghosts", "periodic_wrap", "walls"),
                         [](const auto& set) { return std::string(set.param); });

TEST(EmulatedFrame, IsNotWaitedFor) {
  CountingMemory memory;
  const EmulatedDevice device(memory);
  const auto additions = device.additions([](const std::string&) { return true; });
  const Frames frames = frames_of(scene("single", "periodic_ghosts"), additions, [&](Observation& observation) {
    const std::size_t before = memory.brought;
    TakenFrame taken = taken_by(observation);
    EXPECT_EQ(memory.brought, before);
    return taken;
  });
  EXPECT_FALSE(frames.empty());
}

}  // namespace
