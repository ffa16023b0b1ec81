#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case_texts.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {
namespace {

using testing::changed;
using testing::FakeParameters;
using testing::good_case;
using testing::read_all;

std::string problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Problems problems;
  read_all(text, overrides, problems);
  return problems.text();
}

TEST(ReadCase, TakesEveryKey) {
  Problems problems;
  const Case read = read_all(good_case, {}, problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(read.title, "A case");
  EXPECT_EQ(read.domain.size, (std::vector<double>{10.0, 10.0}));
  EXPECT_EQ(read.boundary.type, "periodic_ghosts");
  EXPECT_EQ(read.boundary.type_key, "domain.boundary");
  EXPECT_EQ(read.boundary.type_place.text(), "case.toml:4:12");
  EXPECT_EQ(read.particles.spacing, 0.625);
  EXPECT_EQ(read.particles.seed, 3);
  EXPECT_EQ(read.kernel.type, "quintic");
  EXPECT_EQ(read.smoothing_length_ratio, 1.3333333);
  ASSERT_EQ(read.initial.size(), 1U);
  EXPECT_EQ(read.initial[0].type, "director");
  EXPECT_EQ(read.initial[0].type_place.text(), "case.toml:12:2");
  EXPECT_EQ(read.time.end, 60.0);
  EXPECT_FALSE(read.time.step.has_value());
  EXPECT_EQ(read.output.interval, 10.0);
  EXPECT_EQ(read.output.checkpoint_interval, 30.0);
  EXPECT_EQ(read.output.fields, (std::vector<std::string>{"velocity", "order_tensor"}));
  EXPECT_TRUE(read.output.fields_given);
  EXPECT_EQ(read.run.precision, Precision::double_precision);
  EXPECT_EQ(read.timings.at(0).interval, 1.0);
  EXPECT_FALSE(read.timings.at(0).every.has_value());
  EXPECT_EQ(read.timings.at(1).every, 20);
}

TEST(ReadCase, KeepsTheOrderOfTheFile) {
  Problems problems;
  const Case read = read_all(good_case, {}, problems);
  ASSERT_EQ(read.physics.size(), 3U);
  EXPECT_EQ(read.physics[0].instance, "flow");
  EXPECT_EQ(read.physics[1].instance, "activity");
  EXPECT_EQ(read.physics[2].instance, "nematic");
  ASSERT_EQ(read.observers.size(), 2U);
  EXPECT_EQ(read.observers[0].instance, "flow");
  EXPECT_EQ(read.observers[1].instance, "area");
}

TEST(ReadCase, FillsPluginParameters) {
  Problems problems;
  const Case read = read_case_text(good_case, "case.toml", {}, problems);
  FakeParameters parameters;
  for (const auto& choice : read.physics) choice.read(parameters.list(choice.type), problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(parameters.viscosity, 0.6667);
  EXPECT_EQ(parameters.activity, 0.05);
  EXPECT_EQ(parameters.bulk_a, -1.0);
  EXPECT_EQ(parameters.bulk_c, 0.5);
  EXPECT_FALSE(parameters.sound_speed.has_value());
}

TEST(ReadCase, HasDefaults) {
  Problems problems;
  const Case read = read_case_text(R"([domain]
size = [1.0, 2.0]
boundary = { type = "walls", slip = true }
[particles]
spacing = 0.1
[kernel]
type = "quintic"
[physics.flow]
type = "flow"
[time]
end = 3
)",
                                   "case.toml", {}, problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(read.particles.arrangement, "lattice");
  EXPECT_EQ(read.particles.seed, 1);
  EXPECT_EQ(read.smoothing_length_ratio, 4.0 / 3.0);
  EXPECT_TRUE(read.initial.empty());
  EXPECT_EQ(read.output.interval, 3.0);
  EXPECT_FALSE(read.output.fields_given);
  EXPECT_EQ(read.run.precision, Precision::single_precision);
  EXPECT_EQ(read.boundary.type, "walls");
  EXPECT_EQ(read.boundary.type_key, "domain.boundary.type");
  bool slip = false;
  ParameterList list;
  list.flag("slip", slip);
  read.boundary.read(list, problems);
  EXPECT_EQ(problems.text(), "");
  EXPECT_TRUE(slip);
}

TEST(ReadCase, TellsPlacesForLaterChecks) {
  Problems problems;
  const Case read = read_case_text(good_case, "case.toml", {}, problems);
  EXPECT_EQ(read.place("kernel.smoothing_length").text(), "case.toml:11:20");
  EXPECT_EQ(read.place("output.fields").text(), "case.toml:38:10");
  EXPECT_EQ(read.place("physics.flow.nothing").text(), "case.toml:16:1");
  EXPECT_EQ(read.place("nothing.at.all").text(), "case.toml:1:1");
}

TEST(ReadCase, ReportsAllErrorsAtOnce) {
  std::string text = changed("activity = 0.05", "activty = 0.05");
  text.replace(text.find("viscosity = 0.6667"), 18, "viscosity = -0.4");
  EXPECT_EQ(problems_of(text),
            "case.toml:19:13: physics.flow.viscosity: must be > 0 Pa s, but is -0.4\n"
            "case.toml:22:1: physics.activity.activty: unknown key; did you mean \"activity\"?");
}

TEST(ReadCase, ThrowsWithTheExitCodeOfABadCase) {
  Problems problems;
  EXPECT_NO_THROW(problems.throw_if_any());
  problems.add({"case.toml", 3, 4}, "time.end", "is wrong");
  try {
    problems.throw_if_any();
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_STREQ(error.what(), "case.toml:3:4: time.end: is wrong");
  }
}

TEST(ReadCase, ReportsUnreadableFiles) {
  Problems problems;
  const Case none = read_case("/no/such/case.toml", {}, problems);
  EXPECT_EQ(problems.text(), "/no/such/case.toml: cannot be read: No such file or directory");
  EXPECT_EQ(none.tree, nullptr);
  EXPECT_EQ(none.place("time.end").text(), "/no/such/case.toml:1:1");
  Problems endless;
  read_case("/dev/zero", {}, endless);
  EXPECT_EQ(endless.text(), "/dev/zero: cannot be read as a case: it is larger than 4 MiB");
}

// Of a folder, the error names the file that is meant if there is no doubt.
TEST(ReadCase, NamesTheCaseInAFolder) {
  const auto scene = std::filesystem::path(::testing::TempDir()) / "mesogen_scene";
  std::filesystem::remove_all(scene);
  std::filesystem::create_directories(scene);
  const auto expect_advice = [&](const std::string& advice) {
    Problems problems;
    read_case(scene.string(), {}, problems);
    EXPECT_EQ(problems.text(), scene.string() + ": cannot be read as a case: it is a folder; give " + advice);
  };
  expect_advice("a file (TOML)");
  std::ofstream(scene / "answer.txt") << "no case";
  std::ofstream(scene / "vortex.toml") << good_case;
  expect_advice((scene / "vortex.toml").string());
  std::ofstream(scene / "answer.toml") << "value = 1";
  expect_advice("a file (TOML)");
  std::ofstream(scene / "case.toml") << good_case;
  expect_advice((scene / "case.toml").string());
  std::filesystem::remove_all(scene);
}

TEST(ReadCase, ReadsAFile) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "mesogen_read_case.toml";
  std::ofstream(file) << good_case;
  Problems problems;
  const Case read = read_case(file.string(), {}, problems);
  EXPECT_EQ(problems.text(), "");
  EXPECT_EQ(read.place("time.end").text(), file.string() + ":28:7");
  std::filesystem::remove(file);
}

TEST(ReadCase, RefusesHalfWrittenFiles) {
  EXPECT_EQ(problems_of(good_case.substr(0, good_case.find("seed = 3") + 7)),
            "case.toml:8:8: not valid TOML: while parsing key-value pair: encountered end-of-file");
  EXPECT_EQ(problems_of("a = \"\xff\""), "case.toml:1:5: not valid TOML: Encountered invalid utf-8 sequence");
}

TEST(ReadCase, RefusesKeysThatWouldExhaustTheStack) {
  std::string key = "a";
  for (int n = 0; n < 300000; ++n) key += ".a";
  EXPECT_EQ(problems_of("title = \"t\"\n" + key + " = 1"),
            "case.toml:2:1: this line has more than 200 dots in a row, too many for a key");
}

TEST(ReadCase, KeepsControlCharactersOutOfMessages) {
  const auto text = problems_of("\"\\u001b[2J\" = 1");
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_NE(text.find("?[2J: unknown section or key"), std::string::npos) << text;
}

TEST(Overrides, ReplaceAndAddValues) {
  Problems problems;
  const Case read =
      read_all(good_case,
               {"time.end=5", "kernel.type=wendland_c4", "domain.size=[4, 5.0]", "particles.spacing = 0.5",
                "title=two words", "time.step=1e-3", "observers.late.type=statistics"},
               problems);
  ASSERT_EQ(problems.text(), "");
  EXPECT_EQ(read.time.end, 5.0);
  EXPECT_EQ(read.kernel.type, "wendland_c4");
  EXPECT_EQ(read.domain.size, (std::vector<double>{4.0, 5.0}));
  EXPECT_EQ(read.title, "two words");
  EXPECT_EQ(read.time.step, 1e-3);
  ASSERT_EQ(read.observers.size(), 3U);
  EXPECT_EQ(read.observers[2].instance, "late");
}

TEST(Overrides, AreCheckedLikeTheFile) {
  EXPECT_EQ(problems_of(good_case, {"physics.nematic.bulk.D=1"}),
            "--set: physics.nematic.bulk.D: unknown key; known here: A, B, C");
  EXPECT_EQ(problems_of(good_case, {"time.end=-1"}), "--set: time.end: must be > 0 s, but is -1");
  EXPECT_EQ(problems_of(good_case, {"time.end=soon"}), "--set: time.end: must be a number in s, > 0, but is \"soon\"");
  EXPECT_EQ(problems_of(good_case, {"time.end.more=1"}),
            "--set: time.end.more: cannot be set, since time.end is no table");
  EXPECT_EQ(problems_of(good_case, {"timestep"}),
            "--set: must be a key and a value, such as physics.flow.viscosity=0.5, but is \"timestep\"");
  EXPECT_EQ(problems_of(good_case, {"a..b=1"}),
            "--set: must be a key and a value, such as physics.flow.viscosity=0.5, but is \"a..b=1\"");
  EXPECT_EQ(problems_of(good_case, {"title=\xff"}), "--set: title: its value is not valid UTF-8");
}

TEST(Overrides, OfAMisspeltSectionAreToldItsName) {
  EXPECT_EQ(
      problems_of(good_case, {"physics.activty.activity=0.1"}),
      "--set: physics.activty.type: must be given: a text (name of the plugin); did you mean \"physics.activity\"?");
  EXPECT_EQ(problems_of(good_case, {"observers.flwo.interval=0.1"}),
            "--set: observers.flwo.type: must be given: a text (name of the plugin); did you mean \"observers.flow\"?");
  EXPECT_EQ(problems_of(good_case, {"physics.other.activity=0.1"}),
            "--set: physics.other.type: must be given: a text (name of the plugin)");
}

}  // namespace
}  // namespace mesogen
