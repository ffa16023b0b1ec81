// Numbers that vary in space and time, in whole cases: what steps go by, and what is refused.

#include <gtest/gtest.h>

#include "error_of.hpp"
#include "lit_scene.hpp"

namespace mesogen {
namespace {

using namespace test;

TEST(Prescribed, AnExpressionOfNumbersIsANumber) {
  CaseRun run(active("'0.6 * viscosity'"), {});
  EXPECT_TRUE(run.setup().prescribed.empty());
  EXPECT_EQ(run.setup().scene.constant("activity"), 0.6);
}

TEST(Prescribed, LimitsGoByTheLargestValue) {
  const auto scene = [](const std::string& activity) { return CaseRun(active(activity)).setup().scene; };
  const Scene varying = scene("'-0.3 * (x < 5) + 0.1 * (x > 5)'");
  EXPECT_DOUBLE_EQ(varying.constant("activity"), -0.3);
  EXPECT_EQ(varying.scales.stress, scene("-0.3").scales.stress);
  EXPECT_TRUE(varying.varying.contains("activity"));
  // Also if it comes later.
  EXPECT_DOUBLE_EQ(CaseRun(active("'0.1 + 0.4 * (t > 2)'"), {"time.end=8.0"}).setup().scene.constant("activity"), 0.5);
  EXPECT_DOUBLE_EQ(CaseRun(active("'0.1 + 0.4 * (t > 2)'"), {"time.end=1.0"}).setup().scene.constant("activity"), 0.1);
}

CaseText fuelled(const std::string& fuel) {
  CaseText text = active("'0.3 * solute'");
  text.section("physics.fuel", "type = \"solute\"\ndiffusivity = 0.01\nsource = 2.0\n" + fuel);
  return text;
}

TEST(Prescribed, AFieldThatStartsFromNothingMustTellHowMuchItBecomes) {
  EXPECT_NE(
      error_of([] { CaseRun run(fuelled("")); }, ExitCode::bad_case)
          .find("physics.activity.activity: \"0.3 * solute\" reads 'solute', and nothing tells how large that gets: "
                "give the key `largest` in the section that brings it"),
      std::string::npos);
  CaseRun run(fuelled("largest = 0.5"));
  EXPECT_DOUBLE_EQ(run.setup().scene.constant("activity"), 0.15);
  const std::string found = error_of([&] { run.run_to(1.0); }, ExitCode::run_failed);
  EXPECT_NE(found.find("the run broke down: 'activity' is 0.18"), std::string::npos) << found;
  EXPECT_NE(found.find("raise the key `largest` in the section that brings what it reads"), std::string::npos) << found;
}

TEST(Prescribed, TwoNumbersOfANameCannotBothBe) {
  CaseText text = active("0.3");
  text.section("physics.wind", "type = \"body_force\"\nforce = ['0.1 * sin(y)', 0.0]");
  EXPECT_NE(
      error_of([&] { CaseRun run(text); }, ExitCode::bad_case)
          .find("physics.wind.force: varies, and physics.push.force is about the same field, 'body_force': put all "
                "of it into one of the two sections, and remove the other"),
      std::string::npos);
}

TEST(Prescribed, FiniteAnchoringNeedsOneElasticConstant) {
  CaseText text(length, 40);
  text.section("solids.rim",
               "shape = \"disc\"\ncentre = [5.0, 5.0]\nradius = 4.0\nfluid = \"inside\"\nanchoring = \"normal\"\n"
               "anchoring_strength = 0.3")
      .section("director", "type = \"uniform\"\nangle = 0.0")
      .flow(1.0)
      .nematic(0.4, 0.7, 0.1);
  EXPECT_NE(
      error_of([&] { CaseRun run(text, {"physics.nematic.elastic_constant='0.1 + 0.01 * x'"}); }, ExitCode::bad_case)
          .find("solids.rim.anchoring_strength: is a strength against an elastic_constant that is the same "
                "everywhere"),
      std::string::npos);
}

TEST(Prescribed, AValueOutOfBoundsEndsTheRun) {
  CaseRun run(active("0.3"),
              {"physics.substrate.coefficient='1 - 3 * (abs(t - 0.02465) < 0.0002)'", "time.step=0.001"});
  const std::string found = error_of([&] { run.run_steps(40); }, ExitCode::run_failed);
  EXPECT_NE(found.find("the run broke down: 'friction' is -2 at particle "), std::string::npos) << found;
  EXPECT_NE(found.find("Mend physics.substrate.coefficient, or let it be as large"), std::string::npos) << found;
  CaseRun late(active("0.3"),
               {"physics.push.force=['if(abs(t - 0.02465) < 0.0002, sqrt(-1), 0.1)', 0.0]", "time.step=0.001"});
  const std::string cause = error_of([&] { late.run_steps(40); }, ExitCode::run_failed);
  EXPECT_NE(cause.find("'body_force' is "), std::string::npos) << cause;
}

TEST(Prescribed, WhatIsWrongIsToldWithItsPlace) {
  const auto refusal = [](const Settings& settings) {
    return error_of([&] { CaseRun run(active("0.3"), settings); }, ExitCode::bad_case);
  };
  const auto expect = [&](const Settings& settings, const std::string& text) {
    const std::string found = refusal(settings);
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  expect({"physics.activity.activity='0.3 * (z < 5)'"},
         "physics.activity.activity: \"0.3 * (z < 5)\": \"z\" is not known");
  expect({"physics.activity.activity='0.3 / (x - x)'"},
         "physics.activity.activity: \"0.3 / (x - x)\" must be finite everywhere, but is ");
  expect({"physics.substrate.coefficient='x - 5'"},
         "physics.substrate.coefficient: \"x - 5\" must be >= 0 kg/(m3 s) everywhere, but is -4.");
  expect({"physics.substrate.coefficient='1 - t'", "time.end=2.0"}, "everywhere, but is -");
  expect({"physics.substrate.coefficient='-viscosity'"}, "\"-viscosity\" must be >= 0 kg/(m3 s) everywhere, but is -1");
  expect({"physics.push.force=['x', 'y', 'x']"}, "physics.push.force: must be a list of 2 numbers");
  expect({"physics.push.force=['x', '1 / (y - y)']"}, "physics.push.force: \"1 / (y - y)\" must be finite everywhere");
  expect(
      {"physics.nematic.elastic_constant='0.1 + 0.01 * x'", "physics.activity.activity='elastic_constant'"},
      "\"elastic_constant\" is prescribed itself, by physics.nematic.elastic_constant: an expression takes constants");
  expect({"physics.nematic.flow_alignment='x'"}, "physics.nematic.flow_alignment: must be a number, but is \"x\"");
  const auto image = [](const std::string& table) { return Settings{"physics.activity.activity=" + table}; };
  expect(image("{ image = 'missing.png', low = 0.0, high = 1.0 }"), "\"missing.png\" cannot be read");
  expect(image("{ image = 'a.png', high = 1.0 }"),
         "low must be given: write { image = \"mask.png\", low = 0.0, high = 1.0 }");
  expect(image("{ image = 'a.png', low = 0.0, hihg = 1.0 }"), "unknown key \"hihg\"; did you mean \"high\"?");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0 }"), "2 images need as many times");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0, times = [1.0, 1.0] }"),
         "times must rise, but 1 comes after 1");
  expect(image("{ image = ['a.png', 'b.png'], low = 0.0, high = 1.0, times = [1.0] }"),
         "times must be as many as the images, 2, but are 1");
  expect(image("{ image = 3, low = 0.0, high = 1.0 }"),
         "image must be the name of a PNG file, or a list of such, but is 3");
}

}  // namespace
}  // namespace mesogen
