#include "case/resolved.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "case_texts.hpp"

namespace mesogen {
namespace {

using testing::changed;
using testing::FakeParameters;
using testing::good_case;

std::string fully_resolved(const Case& source, FakeParameters& parameters, Problems& problems) {
  ResolvedCase resolved(source);
  for (const auto* const group : {&source.initial, &source.physics, &source.observers})
    for (const auto& choice : *group) {
      const auto list = parameters.list(choice.type);
      choice.read(list, problems);
      resolved.add(choice.section, list);
    }
  return resolved.text();
}

TEST(ResolvedCase, HoldsEveryDefault) {
  Problems problems;
  const Case read = read_case_text(good_case, "case.toml", {"particles.arrangement=jittered"}, problems);
  FakeParameters parameters;
  const auto text = fully_resolved(read, parameters, problems);
  ASSERT_EQ(problems.text(), "");
  for (const char* const line :
       {"title = \"A case\"\n", "jitter = 0.2\n", "order = 1.0\n", "step = \"auto\"\n", "factor = 1.0\n",
        "sound_speed = \"auto\"\n", "viscosity_form = \"component_wise\"\n", "shift = true\n", "filter_every = 30\n",
        "bulk = { A = -1.0, C = 0.5, B = 0.0 }\n", "checkpoint_interval = 30.0\n", "every = 20\n", "names = [\"a\"]\n",
        "[physics.nematic]\n", "modes = [\n  [1.0, 0.0, 0.05, 0.3],\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "missing in\n" << text;
}

TEST(ResolvedCase, ReadsBackToTheSameCase) {
  const double third = 1.0 / 3.0;
  const double odd = std::nextafter(0.6667, 1.0);
  Problems problems;
  const Case read =
      read_case_text(good_case, "case.toml",
                     {"director.order=0.33333333333333331", "physics.flow.viscosity=0.66670000000000007"}, problems);
  FakeParameters parameters;
  const auto text = fully_resolved(read, parameters, problems);
  const Case again = read_case_text(text, "resolved.toml", {}, problems);
  FakeParameters parameters_again;
  EXPECT_EQ(fully_resolved(again, parameters_again, problems), text);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(parameters_again.order, third);
  EXPECT_EQ(parameters_again.viscosity, odd);
  EXPECT_EQ(parameters_again.modes, parameters.modes);
  EXPECT_EQ(again.physics.at(1).instance, "activity");
  EXPECT_EQ(again.output.fields, read.output.fields);
  EXPECT_EQ(again.run.precision, read.run.precision);
  EXPECT_EQ(again.timings.at(0).interval, read.timings.at(0).interval);
  EXPECT_EQ(again.timings.at(1).every, read.timings.at(1).every);
}

TEST(ResolvedCase, WithoutPluginsIsPartOfTheCase) {
  Problems problems;
  const Case read = read_case_text(good_case, "case.toml", {}, problems);
  const Case again = read_case_text(read.resolved_text, "resolved.toml", {}, problems);
  EXPECT_EQ(problems.text(), "");
  EXPECT_EQ(again.resolved_text, read.resolved_text);
  EXPECT_NE(read.resolved_text.find("factor = 1.0\n"), std::string::npos);
}

TEST(ResolvedCase, WritesOnlyKeysThatMeanSomething) {
  Problems problems;
  const Case read = read_case_text(changed("end = 60.0", "end = 60.0\nstep = 0.01"), "case.toml", {}, problems);
  EXPECT_EQ(problems.text(), "");
  EXPECT_EQ(read.resolved_text.find("factor"), std::string::npos);
  EXPECT_EQ(read.resolved_text.find("jitter"), std::string::npos);
}

TEST(ResolvedCase, LeavesOutputFieldsToTheScene) {
  Problems problems;
  const Case read = read_case_text(changed("fields = [\"position\", \"velocity\", \"order_tensor\"]\n", ""),
                                   "case.toml", {}, problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(read.resolved_text.find("fields"), std::string::npos);
  ResolvedCase resolved(read);
  resolved.set_output_fields({"velocity"});
  EXPECT_NE(resolved.text().find("fields = [\"velocity\"]\n"), std::string::npos);
}

TEST(ResolvedCase, TurnsABoundaryWithKeysIntoATable) {
  Problems problems;
  const Case read = read_case_text(good_case, "case.toml", {}, problems);
  double slip = 0.25;
  ParameterList list;
  ResolvedCase plain(read);
  plain.add(read.boundary.section, list);
  EXPECT_NE(plain.text().find("boundary = \"periodic_ghosts\"\n"), std::string::npos);
  list.number("slip", slip);
  ResolvedCase resolved(read);
  resolved.add(read.boundary.section, list);
  EXPECT_NE(resolved.text().find("boundary = { type = \"periodic_ghosts\", slip = 0.25 }\n"), std::string::npos);
}

TEST(ResolvedCase, SurvivesCasesThatCouldNotBeRead) {
  for (const char* const text : {"[time", "time = 3", "", "domain = 1\nkernel.smoothing_length.a = 2"}) {
    Problems problems;
    const Case read = read_case_text(text, "case.toml", {}, problems);
    EXPECT_FALSE(problems.empty());
    EXPECT_EQ(read.resolved_text, "");
    EXPECT_NO_THROW((void)ResolvedCase(read).text());
  }
}

TEST(ResolvedCase, QuotesTexts) {
  Problems problems;
  const Case read = read_case_text(changed("\"A case\"", R"("é \"q\" \\ \n \u0001")"), "case.toml", {}, problems);
  const Case again = read_case_text(read.resolved_text, "resolved.toml", {}, problems);
  EXPECT_EQ(problems.text(), "");
  EXPECT_EQ(again.title, read.title);
  EXPECT_EQ(again.title, "é \"q\" \\ \n \x01");
}

}  // namespace
}  // namespace mesogen
