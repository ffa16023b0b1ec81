// Every remedy that a broken run is told is followed here, and the run goes on.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "case_run.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

using Settings = std::vector<std::string>;

/// What the run ends with before `end`; empty if it arrives.
std::string failure(const CaseText& text, double end, const Settings& settings) {
  CaseRun run(text, settings);
  try {
    run.run_to(end);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The case breaks down with this remedy; followed in each of these ways it runs to its end.
void expect_cured(const CaseText& text, double end, const Settings& ill, const std::string& what,
                  const std::string& remedy, const std::vector<Settings>& cures) {
  SCOPED_TRACE(fmt::format("{}\nwith {}", text.text(), fmt::join(ill, ", ")));
  const std::string message = failure(text, end, ill);
  EXPECT_NE(message.find(what), std::string::npos) << "not in: " << message;
  EXPECT_NE(message.find(remedy), std::string::npos) << "not in: " << message;
  for (const Settings& cure : cures) EXPECT_EQ(failure(text, end, cure), "") << remedy;
}

/// Turbulent, and carried along.
CaseText lively(const std::string& flow, const std::string& activity = "") {
  CaseText text(4.0, 20);
  text.boundary("periodic_wrap")
      .modes("director", "[[1, 0, 0.4, 0.3], [0, 1, 0.3, 1.1], [2, -1, 0.1, 0.7]]")
      .section("velocity", "type = \"uniform\"\nvalue = [1.0, -0.6]")
      .section("physics.flow", "type = \"" + flow + "\"\ndensity = 1.0\nviscosity = 0.05")
      .nematic(0.4, 0.7, 0.02)
      .section("physics.activity", "type = \"active_stress\"\nactivity = 0.5\n" + activity)
      .section("time", "end = 1e6");
  return text;
}

/// Vortices, which draw particles out along the lines between them.
CaseText vortices(int across, const std::string& viscosity) {
  CaseText text(4.0, across);
  text.boundary("periodic_wrap")
      .modes("velocity", "[[1, 1, 0.5, 0.3], [1, -1, 0.5, 0.3]]")
      .section("physics.flow", "type = \"wcsph\"\ndensity = 1.0\nviscosity = " + viscosity)
      .section("time", "end = 1e6");
  return text;
}

const std::string keep_apart =
    ". Leave the shift of the flow at its default, or take a smaller step (time.factor = 0.5); ";
const std::string no_shift = "physics.flow.shift = 0.0";

// Whether a pair or a void is found first depends on rounding; the remedy is the same.
TEST(GuardRemedies, OfPairsAndVoids) {
  const std::string what = "the run broke down: ";
  expect_cured(vortices(20, "0.005"), 1.5, {no_shift}, what, keep_apart, {{}});
  expect_cured(lively("incompressible", "form = \"conservative\""), 10.0, {no_shift}, what, keep_apart, {{}});
  // However strong, a shift moves no particle by more than a fifth of a spacing in a step: it drives none off.
  EXPECT_EQ(failure(lively("wcsph"), 2.0, {"physics.flow.shift = 10.0"}), "");
}

TEST(GuardRemedies, OfSpeed) {
  const std::string too_fast = "spacings in one step at";
  for (const char* const flow : {"wcsph", "incompressible"}) {
    expect_cured(lively(flow), 2.0, {"time.factor = 6.0"}, too_fast,
                 "ake a smaller step (time.factor = 0.5); the frames", {{"time.factor = 0.5"}});
    expect_cured(lively(flow), 2.0, {"time.step = 0.1"}, too_fast,
                 "ake a smaller time.step, or leave it to \"auto\"; the frames", {{"time.step = 0.005"}, {}});
  }
  // Particles that come together push each other away, at a speed or a compression that is out of bounds.
  expect_cured(vortices(50, "0.002"), 1.0, {no_shift}, "the run ", "eave the shift o", {{}});
}

TEST(GuardRemedies, OfWhatIsNotFinite) {
  CaseText text(4.0, 20);
  text.modes("director", "[[1, 0, 0.4, 0.3]]").nematic(0.4, 0.7, 0.02).section("time", "end = 1e6");
  expect_cured(text, 1000.0, {"time.step = 20.0"}, "is not finite",
               ". Take a smaller time.step, or leave it to \"auto\"; the frames", {{"time.step = 1.0"}, {}});
  expect_cured(text, 1000.0, {"time.factor = 20.0"}, "is not finite",
               ". Take a smaller step (time.factor = 0.5); the frames", {{"time.factor = 0.5"}});
}

// A constant force on a box that nothing holds back: sound, and ever faster.
TEST(GuardRemedies, OfAStepThatCollapses) {
  CaseText text(4.0, 20);
  text.section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 1.0")
      .modes("director", "[[1, 0, 0.4, 0.3]]")
      .nematic(0.01, 0.7, 0.02)
      .active(1e-4)
      .section("physics.push", "type = \"body_force\"\nforce = [20.0, 0.0]")
      .section("time", "end = 1e6");
  expect_cured(text, 0.6, {}, "where the fluid at rest allows",
               ". If the flow is meant to be so fast, give the step by time.step; the frames", {{"time.step = 0.002"}});
}

TEST(GuardRemedies, OfCompression) {
  const std::string remedy =
      ". If the flow is faster than a tenth of the sound, leave sound_speed and time.step at \"auto\", where the sound "
      "adapts, or raise sound_speed; else leave the shift on and time.scheme at \"midpoint\", or "
      "take a smaller step (time.factor = 0.5); the frames";
  const std::string what = "'compression' is ";
  const auto cured = [&](const CaseText& text, double end, const Settings& ill, const Settings& cure) {
    expect_cured(text, end, ill, what, remedy, {cure});
  };
  cured(lively("wcsph"), 2.0, {"physics.flow.sound_speed = 1.5"}, {"physics.flow.sound_speed = 15.0"});
  cured(lively("wcsph"), 2.0, {"physics.flow.sound_speed = 1.5"}, {});
  CaseText contraction(4.0, 24);
  contraction.boundary("periodic_wrap")
      .section("director", "type = \"perturbed\"\nangle = 22.9183\namplitude = 0.1\nseed = 1")
      .flow(0.05)
      .nematic(0.4, 0.7, 0.02)
      .active(-0.2)
      .section("time", "end = 1e6");
  expect_cured(contraction, 6.0, {"time.step = 0.01"}, "the run ", "\"auto\"", {{}});
  cured(lively("wcsph"), 6.0, {"time.scheme = \"half_steps\"", "physics.flow.density_diffusion = 0.0"}, {});
  // Rounding decides what goes beyond its bounds first.
  expect_cured(lively("wcsph"), 4.0, {"time.factor = 5.0"}, "the run ", "smaller step (time.factor = 0.5); the frames",
               {{"time.factor = 0.5"}});
  // The density filter alone, in all else as wcsph.
  Settings filtered = {"physics.flow.viscosity = 0.005", "physics.flow.sound_speed = 11.66",
                       "physics.flow.viscosity_form = \"component\"", "physics.flow.shift_speed = \"strain\"",
                       "physics.flow.shift = 0.3"};
  Settings cure = filtered;
  cure.emplace_back("physics.flow.density_filter = 0.0");
  expect_cured(lively("wcsph_published"), 20.0, filtered, what, "else set density_filter = 0.0, leave the shift on",
               {cure});
}

// Where the mesh is fine and nothing spreads the particles, some point of it runs empty.
TEST(GuardRemedies, OfAPointOfTheMeshWithoutParticles) {
  const std::string fine = "physics.flow.mesh_spacing = 1.0";
  const std::string dense = "particles.spacing = 0.1";
  expect_cured(
      lively("incompressible"), 17.0, {fine, no_shift, dense}, "a point of the mesh has hardly any particle about it",
      ": leave the shift of the flow at its default, or take a coarser mesh (mesh_spacing of a flow on a mesh)",
      {{fine, dense}, {no_shift, dense}});
}

}  // namespace
