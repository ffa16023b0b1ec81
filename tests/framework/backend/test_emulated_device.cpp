// Runs on a device whose memory is apart, played by the host: the same bits as on the host, whoever works where.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "../run/active_scene.hpp"
#include "counting_memory.hpp"
#include "emulated_device.hpp"
#include "png_file.hpp"
#include "run/closest_pair.hpp"
#include "run/observation.hpp"
#include "test_plugins.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr int steps = 40;
constexpr const char* observers[] = {"flow_statistics", "nematic_statistics", "defects", "mixing", "pathlines"};

using OnDevice = std::function<bool(const std::string& type)>;

bool everybody(const std::string&) { return true; }
bool nobody(const std::string&) { return false; }
/// Fields go to and fro within a step.
bool some(const std::string& type) { return type == "beris_edwards" || type == "friction" || type == "incompressible"; }

/// All that a run tells.
struct Story {
  Checkpoint state;
  std::map<std::string, std::vector<double>> told;  // by step, and observer and quantity or field of a frame

  bool operator==(const Story&) const = default;
};

CaseText observed(CaseText text) {
  for (const std::string name : observers) text.section("observers." + name, "type = \"" + name + "\"\nevery = 1");
  return text.section("colour", "type = \"quarter\"")
      .section("output", "fields = [\"velocity\", \"order_tensor\", \"velocity_gradient\", \"volume\"]");
}

CaseText mesh_scene(const std::string& precision, const std::string& boundary) {
  return active_scene(precision, boundary)
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05");
}

/// A run that is looked at every seventh step, and saved and restored half way.
Story run(const CaseText& text, const SetupAdditions& additions) {
  Story story;
  Checkpoint half_way;
  for (const int part : {0, 1}) {
    const auto setup = put_together(text, built_plugins(), additions);
    Stepper stepper(*setup);
    Observation observation(stepper);
    if (part == 0) {
      stepper.start();
    } else {
      stepper.restore(half_way);
    }
    observation.start();
    if (part == 1) observation.restore(half_way);
    for (int n = 1; n <= steps / 2; ++n) {
      const std::vector<bool> due(setup->observers.size() + 1, n % 7 == 0);
      stepper.advance(stepper.next_step(1e6), due);
      const std::string step = std::to_string(stepper.state().step) + " ";
      observation.sample(due, [&](const std::string& name, const Sample& sample) {
        for (const auto& [quantity, values] : sample.values()) story.told[step + name + " " + quantity] = values;
      });
      if (!due.back()) continue;
      for (const FrameField& field : observation.frame()) story.told[step + field.name] = field.values;
    }
    Checkpoint& checkpoint = part == 0 ? half_way : story.state;
    stepper.save(checkpoint);
    observation.save(checkpoint);
    EXPECT_GT(stepper.state().neighbourhood.sortings(), 1);
  }
  return story;
}

Story run_on_host(const CaseText& text) { return run(text, {}); }

Story run_emulated(const CaseText& text, const OnDevice& on_device) {
  exec::EmulatedMemory memory;
  const EmulatedDevice device(memory);
  const Story story = run(text, device.additions(on_device));
  EXPECT_EQ(memory.held(), 0U);
  return story;
}

// Element by element, since what is not a number, such as a quantity of no defects, is not equal to itself.
void expect_same(const Story& emulated, const Story& host) {
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
  };
  EXPECT_GT(host.told.size(), 20U);
  EXPECT_EQ(emulated.state.integers, host.state.integers);
  for (const auto& [name, values] : host.state.numbers)
    EXPECT_TRUE(same(emulated.state.numbers.at(name), values)) << name;
  for (const auto& [name, values] : host.told) EXPECT_TRUE(same(emulated.told.at(name), values)) << name;
}

class OnAnEmulatedDevice : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(OnAnEmulatedDevice, ARunHasTheBitsOfTheHost) {
  const auto [precision, boundary] = GetParam();
  const CaseText text = observed(active_scene(precision, boundary));
  const Story host = run_on_host(text);
  for (const auto on_device : {&everybody, &nobody, &some}) expect_same(run_emulated(text, on_device), host);
}

INSTANTIATE_TEST_SUITE_P(All, OnAnEmulatedDevice,
                         testing::Combine(testing::Values("single", "double"),
                                          testing::Values("periodic_ghosts", "periodic_wrap", "walls")),
                         [](const auto& set) {
                           return std::string(std::get<0>(set.param)) + "_" + std::get<1>(set.param);
                         });

// Programs, films and what they read go to the device too.
TEST(EmulatedDevice, MakesPrescribedValues) {
  const std::string dark = write_png("emulated_dark.png", 2, 2, {0, 40, 80, 120});
  const std::string bright = write_png("emulated_bright.png", 2, 2, {255, 90, 200, 10});
  CaseText text = observed(active_scene("single", "periodic_wrap"));
  text.section("physics.activity", "type = \"active_stress\"\nactivity = { image = [\"" + dark + "\", \"" + bright +
                                       "\"], times = [0.0, 0.5], low = -0.1, high = 0.4 }")
      .section("physics.fuel", "type = \"solute\"\ndiffusivity = 0.01\nsource = \"0.1 + 0.2 * x * t\"\nlargest = 1.0")
      .section("physics.substrate", "type = \"friction\"\ncoefficient = \"0.3 + 0.1 * sin(y) + solute\"")
      .section("output", "fields = [\"velocity\", \"order_tensor\", \"activity\", \"activity_gradient\"]");
  const Story host = run_on_host(text);
  for (const auto on_device : {&everybody, &nobody, &some}) expect_same(run_emulated(text, on_device), host);
}

// A mesh has loops of its own on a device: the same numbers as on the host but for rounding, and the same bits in every
// run.
TEST(EmulatedDevice, RunsAFlowOnAMesh) {
  const auto velocity = [](const std::string& precision, const SetupAdditions& additions) {
    const auto setup = put_together(mesh_scene(precision, "periodic_ghosts"), built_plugins(), additions);
    Stepper stepper(*setup);
    stepper.start();
    for (int n = 0; n < 20; ++n) stepper.advance(stepper.next_step(1e6), {false});
    Checkpoint checkpoint;
    stepper.save(checkpoint);
    return checkpoint.numbers.at("field velocity 1");
  };
  for (const std::string precision : {"single", "double"}) {
    exec::EmulatedMemory memory;
    const EmulatedDevice device(memory);
    const auto host = velocity(precision, {});
    const auto emulated = velocity(precision, device.additions(everybody));
    ASSERT_EQ(emulated.size(), host.size());
    for (std::size_t i = 0; i < host.size(); ++i)
      EXPECT_NEAR(emulated[i], host[i], precision == "single" ? 1e-5 : 1e-12);
    EXPECT_EQ(emulated, velocity(precision, device.additions(everybody)));
  }
}

// Sums over the mesh and means, whatever the number of particles: no field, no modes. (Where particles are sorted,
// which is not in every step, this device looks for neighbours on the host.)
TEST(EmulatedDevice, AStepOnAMeshCopiesAFewNumbers) {
  CountingMemory memory;
  const EmulatedDevice device(memory);
  CaseText text(4.0, 40);
  text.section("time", "end = 1e6")
      .boundary("periodic_wrap")
      .precision("double")
      .modes("director", "[[1, 0, 0.4, 0.3], [0, 1, 0.3, 1.1], [2, -1, 0.1, 0.7]]")
      .nematic(0.4, 0.7, 0.02)
      .active(0.5)
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05");
  const auto setup = put_together(text, built_plugins(), device.additions(everybody));
  Stepper stepper(*setup);
  stepper.start();
  std::vector<std::size_t> copied;
  for (int n = 0; n < 10; ++n) {
    memory.copied = 0;
    stepper.advance(stepper.next_step(1e6), {false});
    copied.push_back(memory.copied);
  }
  EXPECT_GT(*std::ranges::min_element(copied), 0U);
  EXPECT_LT(*std::ranges::min_element(copied), 4'000U);
}

// All but the flow is on the device.
TEST(EmulatedDevice, RunsAFlowThatComputesOnTheHost) {
  for (const char* const boundary : {"periodic_ghosts", "periodic_wrap"}) {
    const CaseText text = observed(mesh_scene("single", boundary));
    const OnDevice others = [](const std::string& type) { return type != "incompressible"; };
    const Story host = run_on_host(text);
    expect_same(run_emulated(text, others), host);
    expect_same(run_emulated(text, nobody), host);
  }
}

// On the host its stages sum with weights that are kept, on a device with new ones: the same numbers but for rounding.
TEST(EmulatedDevice, StabilisedStepsAreThoseOfTheHost) {
  for (const char* const boundary : {"periodic_ghosts", "walls"}) {
    const CaseText text = active_scene("double", boundary, "stabilised");
    const auto velocity = [&](const SetupAdditions& additions) {
      const auto setup = put_together(text, built_plugins(), additions);
      Stepper stepper(*setup);
      stepper.start();
      for (int n = 0; n < 20; ++n) stepper.advance(stepper.next_step(1e6), {false});
      Checkpoint checkpoint;
      stepper.save(checkpoint);
      return checkpoint.numbers.at("field velocity 1");
    };
    exec::EmulatedMemory memory;
    const EmulatedDevice device(memory);
    const auto host = velocity({});
    for (const auto on_device : {&everybody, &some}) {
      const auto emulated = velocity(device.additions(on_device));
      ASSERT_EQ(emulated.size(), host.size());
      for (std::size_t i = 0; i < host.size(); ++i) EXPECT_NEAR(emulated[i], host[i], 1e-9);
    }
  }
}

TEST(EmulatedDevice, ClosestPairIsThatOfTheHost) {
  const auto closest = [](const SetupAdditions& additions) {
    const auto setup = put_together(active_scene("single"), built_plugins(), additions);
    Stepper stepper(*setup);
    stepper.start();
    for (int n = 0; n < 10; ++n) stepper.advance(stepper.next_step(1e6), {false});
    return closest_pair(stepper.state(), 0.3);
  };
  exec::EmulatedMemory memory;
  const EmulatedDevice device(memory);
  const auto host = closest({});
  const auto emulated = closest(device.additions(everybody));
  ASSERT_TRUE(host && emulated);
  EXPECT_EQ(std::tuple(emulated->a, emulated->b, emulated->distance), std::tuple(host->a, host->b, host->distance));
}

}  // namespace
