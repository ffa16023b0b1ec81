// Advice about kernel, sound, step and precision of a flow: each is followed, and does what it promises.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "followed.hpp"
#include "forecast/memory.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double end = 0.4;

/// Speeds fall as exp(-8 pi^2 nu t).
double error_of_speed(CaseRun& run, double viscosity = 0.01) {
  const double exact = std::sqrt(0.5) * std::exp(-78.9568352 * viscosity * end);
  return std::abs(run.observe("flow_statistics", "v_rms") / exact - 1.0);
}

TEST(Advice, HasNothingToSayOfAGoodCaseButThatItNeedsNoSound) {
  CaseRun run = CaseRun::unstarted(vortices().precision("single"));
  for (const Suggestion& one : advice({run.setup(), forecast_steps(run.setup()), 1e12}))
    EXPECT_EQ(one.name, "no_sound");
}

TEST(Advice, WithoutSoundStepsAreFewerAndTheErrorIsSmall) {
  const CaseText text = vortices().precision("single");
  const auto found = advised(text, "no_sound");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings, std::vector<std::string>{"physics.flow.type=incompressible"});
  EXPECT_EQ(found->finding,
            "sound or viscosity limits the step, and this box is periodic: in an incompressible flow neither limits "
            "the step");
  EXPECT_EQ(found->gain,
            "far fewer steps, and a flow as accurate as Fourier series. It has no sound, compression, equation of the "
            "density or walls");
  CaseRun before(text);
  before.run_to(end);
  CaseRun after(text, found->settings);
  after.run_to(end);
  EXPECT_LT(4 * after.state().step, before.state().step);
  EXPECT_LT(error_of_speed(after), 0.002);
  expect_settled(text, *found);
}

TEST(Advice, WithoutSoundStabilisedStepsAreCheaper) {
  CaseText text(10.0, 48);
  text.precision("single")
      .modes("director", "[[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1]]")
      .flow(2.0 / 3.0)
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .section("time", "end = 10.0")
      .read("\"velocity\", \"volume\"");
  const auto found = advised(text, "no_sound");
  ASSERT_TRUE(found);
  EXPECT_EQ(
      found->finding,
      "viscosity is taken in stages, and this box is periodic: an incompressible flow needs no stages and no sums "
      "over neighbours");
  EXPECT_EQ(found->gain,
            "cheaper steps, and a flow as accurate as Fourier series. It has no sound, compression, equation of the "
            "density or walls");
  CaseRun before(text);
  before.run_to(10.0);
  CaseRun after(text, found->settings);
  after.run_to(10.0);
  EXPECT_LE(after.state().step, before.state().step);
  EXPECT_NEAR(after.observe("flow_statistics", "v_rms") / before.observe("flow_statistics", "v_rms"), 1.0, 0.02);
  expect_settled(text, *found);
}

// Between walls, or with keys of its own, the case asks for the weakly compressible flow.
TEST(Advice, SoundIsLeftWhereItIsNeededOrAskedFor) {
  EXPECT_FALSE(advised(vortices("density_diffusion = 0.05"), "no_sound"));
  EXPECT_FALSE(advised(vortices("motion = \"eulerian\""), "no_sound"));
  EXPECT_FALSE(advised(vortices().boundary("walls"), "no_sound"));
}

TEST(Advice, FewNeighboursGoWrongAndMoreDoNot) {
  for (const char* length : {"1.0", "1.3333333"}) {
    const CaseText text =
        vortices().section("kernel", std::string("type = \"wendland_c2\"\nsmoothing_length = ") + length);
    const auto found = advised(text, "few_neighbours");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->settings, std::vector<std::string>{"kernel.smoothing_length=2"});
    CaseRun before(text);
    double wrong = std::numeric_limits<double>::infinity();
    try {
      before.run_to(end);
      wrong = error_of_speed(before);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("the run broke down"), std::string::npos) << error.what();
    }
    CaseRun after(text, found->settings);
    after.run_to(end);
    EXPECT_LT(error_of_speed(after), 0.015);
    EXPECT_GT(wrong, 4.0 * error_of_speed(after));
    EXPECT_GT(after.observe("flow_statistics", "min_spacing"), 0.4);
    EXPECT_GT(after.stepper().control().at_rest(), before.stepper().control().at_rest());
    expect_settled(text, *found);
  }
}

TEST(Advice, FasterSoundVariesDensityLess) {
  const CaseText text = vortices("sound_speed = 6.0");
  const auto found = advised(text, "sound_too_slow");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->settings, std::vector<std::string>{"physics.flow.sound_speed=auto"});
  EXPECT_EQ(found->gain, "the density varies some 2.7 times less");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(end);
  const double less = density_variation(before) / density_variation(after);
  EXPECT_GT(less, 0.5 * 2.7);
  EXPECT_LT(less, 2.0 * 2.7);
  EXPECT_LT(error_of_speed(after), 0.005);
  expect_settled(text, *found);
}

// Where viscosity binds the step.
TEST(Advice, FasterSoundThatIsFreeTakesNoMoreSteps) {
  const CaseText text = vortices("sound_speed = 15.0", 1.0).section("time", "end = 1.0\nstepping = \"explicit\"");
  const auto found = advised(text, "sound_too_slow");
  ASSERT_TRUE(found);
  EXPECT_NE(found->finding.find("up to that value a higher one costs nothing"), std::string::npos) << found->finding;
  CaseRun before(text);
  CaseRun after(text, found->settings);
  EXPECT_DOUBLE_EQ(after.stepper().control().at_rest(), before.stepper().control().at_rest());
  for (CaseRun* run : {&before, &after}) run->run_to(0.02);
  EXPECT_GT(density_variation(before) / density_variation(after), 4.0);
  EXPECT_EQ(after.state().step, before.state().step);
}

TEST(Advice, SlowerSoundTakesFewerSteps) {
  const CaseText text = vortices("sound_speed = 20.0");
  const auto found = advised(text, "sound_too_fast");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->gain, "2 times fewer steps");
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(end);
  EXPECT_NEAR(static_cast<double>(before.state().step) / static_cast<double>(after.state().step), 2.0, 0.1);
  EXPECT_LT(error_of_speed(after), 0.03);
  EXPECT_LT(density_variation(after), 0.05);
  expect_settled(text, *found);
}

TEST(Advice, LongerStepsAreAsGood) {
  for (const char* time : {"end = 0.4\nfactor = 0.5", "end = 0.4\nstep = 0.00055"}) {
    const CaseText text = vortices().section("time", time);
    const auto found = advised(text, "short_step");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->gain, "up to 2 times fewer steps; the answer is as good");
    CaseRun before(text);
    CaseRun after(text, found->settings);
    for (CaseRun* run : {&before, &after}) run->run_to(end);
    EXPECT_NEAR(static_cast<double>(before.state().step) / static_cast<double>(after.state().step), 2.0, 0.1);
    EXPECT_LT(error_of_speed(after), error_of_speed(before) + 0.005);
    expect_settled(text, *found);
  }
}

TEST(Advice, SinglePrecisionGivesTheSameAnswer) {
  CaseText text(10.0, 24);
  text.modes("director", "[[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1], [1, 1, 0.02, 2.0], [2, -1, 0.02, 0.7]]")
      .flow(2.0 / 3.0)
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .read("\"velocity\", \"velocity_gradient\"");
  const auto found = advised(text, "double_precision");
  ASSERT_TRUE(found);
  CaseRun before(text);
  CaseRun after(text, found->settings);
  for (CaseRun* run : {&before, &after}) run->run_to(20.0);
  for (const char* quantity : {"v_rms", "vorticity_rms"})
    EXPECT_NEAR(after.observe("flow_statistics", quantity) / before.observe("flow_statistics", quantity), 1.0, 1e-3);
  EXPECT_EQ(after.state().step, before.state().step);
  EXPECT_LT(frame_bytes(after.setup()), 0.8 * frame_bytes(before.setup()));
  EXPECT_FALSE(advised(text.precision("single"), "double_precision"));
}

}  // namespace
