// Where a flow or a stress outgrows what the start told, the sound of a weakly compressible flow gets faster.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "active_scene.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double allowed = 0.01;  // density_variation, by default

/// c0 as the limit on the step shows it, 0.25 h / c0; 0 where there is no sound.
double sound_speed(CaseRun& run) {
  const Scene& scene = run.setup().scene;
  for (const auto& member : run.setup().physics)
    for (const PassList::Limit& limit : member.passes.step_limits())
      if (limit.cause == StepCause::sound) return 0.25 * scene.smoothing_length / limit.seconds(scene);
  return 0.0;
}

double largest_compression(CaseRun& run) {
  double largest = 0.0;
  for (const double c : run.field("compression")) largest = std::max(largest, std::abs(c));
  return largest;
}

CaseText nearly_uniform(double viscosity, double elastic_constant, double activity) {
  CaseText text(4.0, 24);
  text.boundary("periodic_wrap")
      .section("director", "type = \"perturbed\"\nangle = 22.9183\namplitude = 0.1\nseed = 1")
      .flow(viscosity)
      .nematic(0.4, 0.7, elastic_constant)
      .active(activity)
      .section("time", "end = 1e6");
  return text;
}

/// A contraction: it ran away within 5 s.
CaseText contraction() { return nearly_uniform(0.05, 0.02, -0.2); }

/// Activity winds the director, and its elasticity becomes the larger stress: 5 % by t = 20 s.
CaseText elastic_growth() {
  return nearly_uniform(0.05, 0.3 * 0.05 * 0.05, 0.2).section("physics.elasticity", "type = \"elastic_stress\"");
}

/// A force along walls on slow vortices: the flow gets 500 times faster.
CaseText driven() {
  CaseText text(4.0, 24);
  text.boundary("walls")
      .modes("velocity", "[[2, 1, 0.01, 0.3], [1, -1, 0.01, 0.9]]")
      .flow(0.05)
      .section("physics.drive", "type = \"body_force\"\nforce = [1.0, 0.0]")
      .section("time", "end = 1e6");
  return text;
}

/// A wall that slides winds up the director that the other one holds.
CaseText wound_up() {
  CaseText text(4.0, 24);
  text.section("domain",
               "size = [4.0, 4.0]\nboundary = { type = \"walls\", anchoring = \"planar\", velocity_high = 0.6 }")
      .section("director", "type = \"uniform\"")
      .flow(0.1)
      .nematic(0.1, 0.3, 0.001)
      .section("physics.elasticity", "type = \"elastic_stress\"")
      .section("time", "end = 1e6");
  return text;
}

struct Growth {
  const char* name;
  CaseText (*scene)();
  double begin;  // when it has grown, s
  double end;
};

constexpr int samples = 40;

/// Largest |c| where the case gives the sound; infinite if the run breaks down.
double largest_with_sound(const Growth& growth, double speed) {
  CaseRun run(growth.scene(), {"physics.flow.sound_speed = " + std::to_string(speed)});
  double largest = 0.0;
  try {
    for (int n = 1; n <= samples; ++n) {
      run.run_to(growth.end * n / samples);
      largest = std::max(largest, largest_compression(run));
    }
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed) << error.what();
    return HUGE_VAL;
  }
  return largest;
}

class AdaptiveSound : public testing::TestWithParam<Growth> {};

// Over a while as long as sound takes through the box, on average.
TEST_P(AdaptiveSound, KeepsTheDensityNearWhatWasAllowed) {
  const Growth& growth = GetParam();
  CaseRun run(growth.scene());
  const double at_start = sound_speed(run);
  run.run_to(growth.begin);
  double sum = 0.0;
  double most = 0.0;
  for (int n = 1; n <= samples; ++n) {
    run.run_to(growth.begin + n * (growth.end - growth.begin) / samples);
    sum += largest_compression(run) / samples;
    most = std::max(most, largest_compression(run));
  }
  EXPECT_GT(sound_speed(run), 1.4 * at_start);
  EXPECT_LT(sum, 3.2 * allowed);
  EXPECT_LT(most, 12.0 * allowed);
  EXPECT_GT(largest_with_sound(growth, at_start), 3.0 * allowed);
}

INSTANTIATE_TEST_SUITE_P(All, AdaptiveSound,
                         testing::Values(Growth{"Contraction", contraction, 6.0, 12.0},
                                         Growth{"ElasticGrowth", elastic_growth, 15.0, 22.0},
                                         Growth{"Driven", driven, 1.0, 4.0}, Growth{"WoundUp", wound_up, 6.0, 12.0}),
                         [](const auto& set) { return std::string(set.param.name); });

/// Steps until the sound is about to rise: it does in the step that follows.
void run_to_rise(CaseRun& run) {
  const double before = sound_speed(run);
  Checkpoint checkpoint;
  for (int n = 0; n < 2000; ++n) {
    run.stepper().save(checkpoint);
    if (checkpoint.numbers.at("physics.flow keeps sound").at(1) > before) return;
    run.run_steps(1);
  }
  FAIL() << "the sound stays";
}

std::vector<double> pressure(CaseRun& run) {
  auto values = run.field("compression");
  const double stiffness = std::pow(sound_speed(run), 2) / 7.0;
  for (double& c : values) c = stiffness * std::expm1(7.0 * std::log1p(c));
  return values;
}

TEST(AdaptedSound, LeavesThePressureAsItIs) {
  for (const bool single : {true, false}) {
    const CaseText text = contraction().precision(single ? "single" : "double");
    CaseRun run(text);
    run_to_rise(run);
    Checkpoint checkpoint;
    run.stepper().save(checkpoint);
    const double slow = sound_speed(run);
    run.run_steps(1);
    EXPECT_GT(sound_speed(run), 1.3 * slow);
    ASSERT_EQ(run.stepper().changes().size(), 1U);
    EXPECT_EQ(run.stepper().changes()[0].rfind("physics.flow: sound_speed rises from 4.47", 0), 0U)
        << run.stepper().changes()[0];
    // The same step without.
    checkpoint.numbers.at("physics.flow keeps sound").at(1) = 0.0;
    CaseRun without = CaseRun::unstarted(text);
    without.stepper().restore(checkpoint);
    without.run_steps(1);
    EXPECT_EQ(sound_speed(without), slow);
    EXPECT_EQ(run.field("velocity", 0), without.field("velocity", 0));
    const auto risen = pressure(run);
    const auto expected = pressure(without);
    double error = 0.0;
    for (std::size_t i = 0; i < risen.size(); ++i) error = std::max(error, std::abs(risen[i] - expected[i]));
    EXPECT_LT(error, (single ? 1e-6 : 1e-14) * slow * slow);
    // Steps follow.
    EXPECT_NEAR(run.stepper().next_step(1e6).seconds / without.stepper().next_step(1e6).seconds,
                slow / sound_speed(run), 1e-8);
    run.run_steps(1);
    EXPECT_TRUE(run.stepper().changes().empty());
  }
}

TEST(AdaptedSound, HasTheSameBitsInAResumedRun) {
  CaseRun unbroken(contraction().precision("single"));
  run_to_rise(unbroken);
  Checkpoint pending;
  unbroken.stepper().save(pending);
  const double slow = sound_speed(unbroken);
  unbroken.run_steps(20);
  Checkpoint risen;
  unbroken.stepper().save(risen);
  EXPECT_GT(sound_speed(unbroken), slow);
  unbroken.run_steps(40);
  for (const auto& [checkpoint, steps] : {std::pair{&pending, 60}, std::pair{&risen, 40}}) {
    CaseRun resumed(contraction().precision("single"));
    resumed.stepper().restore(*checkpoint);
    resumed.run_steps(steps);
    EXPECT_EQ(resumed.time(), unbroken.time());
    EXPECT_EQ(sound_speed(resumed), sound_speed(unbroken));
    EXPECT_EQ(state_of(resumed), state_of(unbroken));
  }
}

TEST(AdaptedSound, HasTheSameBitsFromAnyNumberOfThreads) {
  const CaseText text = contraction().precision("single");
  CaseRun grown(text);
  run_to_rise(grown);
  Checkpoint checkpoint;
  grown.stepper().save(checkpoint);
  const int threads = omp_get_max_threads();
  const auto run_with = [&](int count) {
    omp_set_num_threads(count);
    CaseRun run = CaseRun::unstarted(text);
    run.stepper().restore(checkpoint);
    run.run_steps(4);
    omp_set_num_threads(threads);
    auto all = state_of(run);
    all.push_back({run.time(), sound_speed(run)});
    return all;
  };
  const auto one = run_with(1);
  EXPECT_GT(one.back()[1], sound_speed(grown));
  EXPECT_EQ(one, run_with(2));
  EXPECT_EQ(one, run_with(3));
}

TEST(AdaptedSound, StaysWhereTheCaseGivesItOrTheStep) {
  for (const char* const given : {"physics.flow.sound_speed = 6.0", "time.step = 0.004"}) {
    CaseRun run(contraction(), {given});
    const double at_start = sound_speed(run);
    run.run_to(4.6);
    EXPECT_GT(largest_compression(run), 3.0 * allowed) << given;
    EXPECT_EQ(sound_speed(run), at_start) << given;
  }
}

// Turbulence whose stress is told at the start, and a rough start.
TEST(AdaptedSound, StaysWhereTheStartToldEnough) {
  CaseRun extensile(nearly_uniform(0.1, 0.02, 0.5));
  const double at_start = sound_speed(extensile);
  extensile.run_to(15.0);
  EXPECT_GT(extensile.observe("flow_statistics", "v_rms"), 0.2);
  EXPECT_EQ(sound_speed(extensile), at_start);
  CaseText text(4.0, 20);
  text.section("particles", "spacing = 0.2\narrangement = \"jittered\"\njitter = 0.5\nseed = 1")
      .modes("velocity", "[[1, 1, 0.1, 0.3]]")
      .flow(0.05);
  CaseRun rough(text);
  const double of_vortices = sound_speed(rough);
  rough.run_to(1.0);
  EXPECT_EQ(sound_speed(rough), of_vortices);
}

}  // namespace
