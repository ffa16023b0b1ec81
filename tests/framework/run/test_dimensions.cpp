#include <gtest/gtest.h>

#include <string>

#include "case/case.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "plugin/registry.hpp"
#include "run/setup.hpp"

namespace mesogen {
namespace {

/// What is said about a case whose plugins are those of tests/broken_plugins/solid.cpp, of three dimensions alone.
std::string refusal(const std::string& size) {
  const std::string text =
      "[domain]\n"
      "size = " +
      size +
      "\n"
      "boundary = \"solid_boundary\"\n"
      "[particles]\n"
      "spacing = 0.1\n"
      "[kernel]\n"
      "type = \"solid_kernel\"\n"
      "[solid_initial]\n"
      "[physics.flow]\n"
      "type = \"solid_physics\"\n"
      "[observers.seen]\n"
      "type = \"solid_observer\"\n"
      "[time]\n"
      "end = 1.0\n";
  const auto registry = PluginRegistry::only({MESOGEN_TEST_BROKEN_PLUGINS "/solid"});
  Problems problems;
  Case source = read_case_text(text, "case.toml", {}, problems);
  try {
    (void)set_up(std::move(source), registry, problems);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  return "no error";
}

TEST(Dimensions, PluginsWithoutAFormForTheSceneAreToldAllAtOnce) {
  const auto of = [](const std::string& place, const std::string& kind) {
    return "case.toml:" + place + ": the " + kind + " plugin \"solid_" + kind +
           "\" has no form for 2 dimensions: it has one for 3; a scene has as many dimensions as domain.size has "
           "numbers";
  };
  EXPECT_EQ(refusal("[1.0, 1.0]"), of("3:12: domain.boundary", "boundary") + "\n" + of("7:8: kernel.type", "kernel") +
                                       "\n" + of("8:2: solid_initial", "initial") + "\n" +
                                       of("10:8: physics.flow.type", "physics") + "\n" +
                                       of("12:8: observers.seen.type", "observer"));
}

TEST(Dimensions, OfASceneAreThoseThatAreBuilt) {
  EXPECT_EQ(refusal("[1.0, 1.0, 1.0]"),
            "case.toml:2:8: domain.size: has 3 numbers, which means 3 dimensions, but this Mesogen is built for 2 "
            "dimensions: give 2 numbers in m");
}

}  // namespace
}  // namespace mesogen
