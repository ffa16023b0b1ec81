// Against flows whose vorticity and stream function are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "case_run.hpp"
#include "case_text.hpp"
#include "mesogen/testing/plugin_harness.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::testing;

constexpr double k = 2.0 * std::numbers::pi;  // box of 1 m

TestScene scene_of(const std::string& arrangement, int across = 32) {
  TestScene scene;
  scene.arrangement = arrangement;
  scene.across = across;
  return scene;
}

// Taylor-Green: psi = sin kx sin ky / k.
double u(double x, double y) { return std::sin(k * x) * std::cos(k * y); }
double v(double x, double y) { return -std::cos(k * x) * std::sin(k * y); }
double psi(double x, double y) { return std::sin(k * x) * std::sin(k * y) / k; }
double omega(double x, double y) { return 2.0 * k * std::sin(k * x) * std::sin(k * y); }

/// Largest distance of a field from a function, of all particles.
double error_of(PluginHarness& run, const std::string& field, const PluginHarness::Function& known) {
  const auto x = run.position(0);
  const auto y = run.position(1);
  const auto values = run.values(field);
  double error = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) error = std::max(error, std::abs(values[i] - known(x[i], y[i])));
  return error;
}

TEST(FlowFields, TheStreamFunctionOfVorticesIsTheirs) {
  for (const char* const arrangement : {"lattice", "hexagonal", "jittered"}) {
    PluginHarness run(PluginKind::physics, "flow_fields", "", scene_of(arrangement));
    run.set("velocity", {u, v});
    const double error = error_of(run, "stream_function", psi) * k;
    EXPECT_LT(error, std::string(arrangement) == "lattice" ? 1e-4 : 1e-3) << arrangement;
  }
}

// A flow that is carried along, and sources that lie in it, have the stream function of the flow.
TEST(FlowFields, TheMeanAndWhatDivergesHaveNoStreamFunction) {
  PluginHarness run(PluginKind::physics, "flow_fields", "", scene_of("lattice"));
  run.set("velocity", {[](double x, double y) { return u(x, y) + 3.0 + std::cos(k * x); },
                       [](double x, double y) { return v(x, y) - 2.0 + std::sin(3.0 * k * y); }});
  EXPECT_LT(error_of(run, "stream_function", psi) * k, 1e-4);
  const auto values = run.values("stream_function");
  EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()), 0.0, 1e-12);
}

// Sums over neighbours: the error falls with the square of the spacing.
TEST(FlowFields, VorticityIsThatOfTheGradientOfTheScene) {
  const auto error = [](int across) {
    PluginHarness run(PluginKind::physics, "flow_fields", "", scene_of("lattice", across));
    run.set("velocity", {u, v});
    const auto uy = run.values("velocity_gradient", 1);
    const auto vx = run.values("velocity_gradient", 2);
    const auto vorticity = run.values("vorticity");
    for (std::size_t i = 0; i < uy.size(); ++i) EXPECT_EQ(vorticity[i], vx[i] - uy[i]);
    return error_of(run, "vorticity", omega) / (2.0 * k);
  };
  const double coarse = error(24);
  EXPECT_LT(coarse, 0.06);
  EXPECT_NEAR(coarse / error(48), 4.0, 0.3);
}

TEST(FlowFields, OfAnIncompressibleFlowBothAreThoseOfItsMesh) {
  TestScene scene = scene_of("jittered");
  scene.step = 0.01;
  scene.more = "[physics.flow]\ntype = \"incompressible\"\ndensity = 1.0\nviscosity = 0.01\n";
  PluginHarness run(PluginKind::physics, "flow_fields", "", scene);
  run.set("velocity", {u, v});
  run.step(10);
  const double left = std::exp(-2.0 * 0.01 * k * k * run.time());
  EXPECT_LT(left, 0.95);
  EXPECT_LT(error_of(run, "stream_function", [&](double x, double y) { return left * psi(x, y); }) * k, 2e-3);
  EXPECT_LT(error_of(run, "vorticity", [&](double x, double y) { return left * omega(x, y); }) / (2.0 * k), 5e-3);
}

// The run of another flow, of which only the stream function is read: sound, and steps that know nothing of it.
TEST(FlowFields, AStepMakesNeither) {
  test::CaseText text(1.0, 24);
  text.modes("velocity", "[[1, 1, 0.05, 0.0], [1, -1, -0.05, 0.0]]").flow(0.01, "sound_speed = 10.0");
  text.section("physics.shown", "type = \"flow_fields\"\n");
  test::CaseText read = text;
  read.read("\"stream_function\"");
  test::CaseRun without(text);
  test::CaseRun with(read);
  without.run_steps(5);
  with.run_steps(5);
  for (const ScheduledPass& scheduled : with.setup().graph->passes())
    if (scheduled.owner == "physics.shown") {
      EXPECT_FALSE(scheduled.for_integration) << scheduled.title();
      EXPECT_EQ(scheduled.pruned(), scheduled.pass.name == "vorticity, for readers") << scheduled.title();
      EXPECT_EQ(scheduled.counter.runs, 0) << scheduled.title();
    }
  EXPECT_EQ(with.path(0), without.path(0)) << "who looks changes nothing";
  const auto values = with.field("stream_function");
  EXPECT_NEAR(*std::max_element(values.begin(), values.end()), 0.1, 0.005);
}

TEST(FlowFields, BetweenWallsThereIsVorticityAlone) {
  TestScene scene = scene_of("lattice");
  scene.boundary = "walls";
  PluginHarness run(PluginKind::physics, "flow_fields", "", scene);
  run.set("velocity", {[](double, double y) { return 0.3 * y; }, [](double, double) { return 0.0; }});
  const auto vorticity = run.values("vorticity");
  EXPECT_NEAR(vorticity[vorticity.size() / 2 + 16], -0.3, 1e-9);
  try {
    (void)run.values("stream_function");
    FAIL() << "a stream function of periodic waves between walls";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    EXPECT_NE(std::string(error.what())
                  .find("the stream function exists only in a periodic box, and this box has walls: remove "
                        "stream_function from output.fields and from what observers read"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
