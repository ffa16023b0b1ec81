// The incompressible flow with all of the nematic: the deterministic benchmark against the pseudo-spectral solution,
// with and without inertia, its order in time, and that a run can be resumed and replayed.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "case_run.hpp"
#include "run/closest_pair.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

CaseText benchmark(int across, const std::string& more = "", const std::string& time = "end = 1e6") {
  CaseText text(10.0, across);
  text.modes("director",
             "[[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1], [1, 1, 0.02, 2.0], [2, -1, 0.02, 0.7], [3, 1, 0.01, 1.9]]")
      .section("physics.flow",
               fmt::format("type = \"incompressible\"\ndensity = 1.0\nviscosity = {:.17g}\n{}", 2.0 / 3.0, more))
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .section("time", time)
      .read("\"velocity\", \"velocity_gradient\", \"order_tensor_gradient\", \"volume\"");
  return text;
}

struct Reference {
  double time, v_rms, vorticity_rms, mean_order;
};

TEST(IncompressibleBenchmark, IsThatOfTheSpectralSolution) {
  CaseRun run(benchmark(48));
  for (const auto& [time, v_rms, vorticity_rms, mean_order] : {Reference{20.0, 0.023717, 0.015179, 0.99538},
                                                               {40.0, 0.075667, 0.048651, 0.95407},
                                                               {60.0, 0.084167, 0.058561, 0.92138}}) {
    run.run_to(time);
    EXPECT_NEAR(run.observe("flow_statistics", "v_rms") / v_rms, 1.0, 5e-4) << "t = " << time;
    EXPECT_NEAR(run.observe("flow_statistics", "vorticity_rms") / vorticity_rms, 1.0, 5e-4) << "t = " << time;
    EXPECT_NEAR(run.observe("nematic_statistics", "mean_order"), mean_order, 2e-4) << "t = " << time;
  }
  // Nobody sums over neighbours but for the volumes that an observer asks for.
  EXPECT_FALSE(run.setup().graph->sums_pairs());
}

TEST(IncompressibleBenchmark, IsThatOfTheStokesSolution) {
  CaseRun run(benchmark(48, "inertia = false"));
  for (const auto& [time, v_rms] : {std::pair{10.0, 0.022271}, {20.0, 0.051984}, {40.0, 0.092817}}) {
    run.run_to(time);
    EXPECT_NEAR(run.observe("flow_statistics", "v_rms") / v_rms, 1.0, 2e-3) << "t = " << time;
  }
}

TEST(IncompressibleBenchmark, IsOfSecondOrderInTime) {
  const auto speed = [](double step) {
    CaseRun run(benchmark(24, "", fmt::format("end = 1e6\nstep = {}", step)));
    run.run_to(20.0);
    return run.observe("flow_statistics", "v_rms");
  };
  const double coarse = speed(0.4);
  const double middle = speed(0.2);
  const double fine = speed(0.1);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 2.0, 0.3);
}

TEST(IncompressibleBenchmark, KeepsMomentum) {
  CaseRun run(benchmark(36));
  run.run_to(40.0);
  const auto momentum = run.sample("flow_statistics").values().at("total_momentum");
  const double scale = 100.0 * run.observe("flow_statistics", "v_rms");
  EXPECT_LT(std::abs(momentum[0]), 1e-4 * scale);
  EXPECT_LT(std::abs(momentum[1]), 1e-4 * scale);
}

/// Turbulent, with all that can be loaded beside it, in single precision: particles cross faces and are stored anew.
CaseText lively(const std::string& boundary) {
  CaseText text(4.0, 24);
  text.boundary(boundary)
      .precision("single")
      .modes("director", "[[1, 0, 0.4, 0.3], [0, 1, 0.3, 1.1], [2, -1, 0.1, 0.7]]")
      .section("velocity", "type = \"uniform\"\nvalue = [1.0, -0.6]")
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.05")
      .nematic(0.4, 0.7, 0.02)
      .active(0.5)
      .section("physics.elasticity", "type = \"elastic_stress\"")
      .section("physics.substrate", "type = \"friction\"\ncoefficient = 0.1");
  return text;
}

/// The same with a stress that is summed over neighbours: close pairs are moved apart.
CaseText summed(const std::string& boundary) {
  return lively(boundary).section("physics.activity",
                                  "type = \"active_stress\"\nactivity = 0.5\nform = \"conservative\"");
}

std::vector<std::vector<double>> state_of(CaseRun& run) {
  std::vector<std::vector<double>> all;
  for (const int c : {0, 1}) {
    all.push_back(run.path(c));
    all.push_back(run.field("velocity", c));
    all.push_back(run.field("order_tensor", c));
  }
  return all;
}

TEST(IncompressibleSameBits, FromOneThreadAndThree) {
  const int threads = omp_get_max_threads();
  const auto run_with = [&](int count) {
    omp_set_num_threads(count);
    CaseRun run(summed("periodic_wrap"));
    run.run_steps(80);
    omp_set_num_threads(threads);
    EXPECT_GE(run.state().neighbourhood.sortings(), 3);
    return state_of(run);
  };
  EXPECT_EQ(run_with(1), run_with(3));
}

TEST(IncompressibleSameBits, FromASavedAndRestoredRun) {
  for (const CaseText& text : {lively("periodic_wrap"), lively("periodic_ghosts"), summed("periodic_wrap")}) {
    CaseRun unbroken(text);
    unbroken.run_steps(45);
    Checkpoint checkpoint;
    unbroken.stepper().save(checkpoint);
    unbroken.run_steps(40);
    CaseRun resumed = CaseRun::unstarted(text);
    resumed.stepper().restore(checkpoint);
    resumed.run_steps(40);
    EXPECT_EQ(resumed.time(), unbroken.time());
    EXPECT_EQ(state_of(resumed), state_of(unbroken)) << text.text();
  }
}

template <class Action>
void expect_error(ExitCode code, const char* text, const Action& action) {
  try {
    action();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_STREQ(error.what(), text);
  }
}

TEST(IncompressibleSameBits, ACheckpointWithoutTheFlowIsRefused) {
  CaseRun run(lively("periodic_wrap"));
  Checkpoint checkpoint;
  run.stepper().save(checkpoint);
  checkpoint.numbers.erase("physics.flow keeps newer force");
  CaseRun other = CaseRun::unstarted(lively("periodic_wrap"));
  // 16 x 16 points: 16 x 9 modes of two components, two numbers each.
  expect_error(ExitCode::bad_case,
               "the checkpoint has no 'physics.flow keeps newer force' for 576 numbers: it belongs to another case",
               [&] { other.stepper().restore(checkpoint); });
}

TEST(IncompressibleSameBits, NumbersThatAPluginKeepsAreAsManyAsItTold) {
  CaseRun run(lively("periodic_wrap"));
  std::vector<double> two(2);
  run.setup().physics.front().passes.keep("more", 3, [&] { return std::span<double>(two); });
  Checkpoint checkpoint;
  expect_error(ExitCode::plugin_refused,
               "physics.flow keeps 'more' as 2 numbers, where it told of 3: name the number that there are",
               [&] { run.stepper().save(checkpoint); });
}

// From rest nothing moves at first; the steps must follow what drives the fluid all the same.
TEST(IncompressibleSteps, AFlowFromRestIsFollowed) {
  CaseText text(1.0, 16);
  text.section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.01")
      .section("physics.push", "type = \"body_force\"\nforce = [1.0, 0.0]");
  CaseRun run(text);
  run.run_to(0.5);
  EXPECT_GT(run.state().step, 5);
  for (const double u : run.field("velocity", 0)) ASSERT_NEAR(u, 0.5, 1e-12);
  for (const double x : run.path(0)) ASSERT_GT(x, 0.124);
}

// Turbulence stretches and folds what the mesh sees as even: without a push between neighbours some pair comes within
// a tenth of a spacing in some 50 s, whatever the seed.
TEST(IncompressibleNeighbourSums, ParticlesStayApartInTurbulence) {
  for (const double activity : {0.08, -0.08}) {
    CaseText text(10.0, 32);
    text.boundary("periodic_wrap")
        .precision("single")
        .section("director", "type = \"perturbed\"\namplitude = 0.3")
        .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.2")
        .nematic(0.4, 0.7, 0.02)
        .section("physics.activity",
                 fmt::format("type = \"active_stress\"\nactivity = {}\nform = \"conservative\"", activity))
        .section("time", "end = 1e6")
        .read("\"velocity\", \"velocity_gradient\", \"volume\"");
    CaseRun run(text);
    for (double time = 20.0; time < 101.0; time += 20.0) {
      run.run_to(time);
      const auto volumes = run.field("volume");
      const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
      const double even = 100.0 / (32.0 * 32.0);
      EXPECT_GT(*least, 0.9 * even) << "t = " << time;
      EXPECT_LT(*most, 1.1 * even) << "t = " << time;
      EXPECT_FALSE(closest_pair(run.state(), 0.35 * 10.0 / 32.0)) << "t = " << time;
    }
    EXPECT_GT(run.observe("flow_statistics", "v_rms"), 0.05);
  }
}

// Who reads neighbours from outside changes nothing: close pairs are left to the mesh.
TEST(IncompressibleNeighbourSums, OfAnObserverMoveNobody) {
  const auto state = [](const std::string& fields) {
    CaseText text = benchmark(24).read(fields);
    CaseRun run(text);
    run.run_steps(60);
    return state_of(run);
  };
  EXPECT_EQ(state("\"velocity\", \"velocity_gradient\""), state("\"velocity\", \"volume\", \"velocity_laplacian\""));
}

TEST(IncompressibleGhosts, AreAsGoodAsWrapping) {
  const auto state = [](const char* boundary) {
    CaseRun run(lively(boundary).precision("double"));
    run.run_steps(20);
    return state_of(run);
  };
  // Particles are stored in another order, so sums are rounded otherwise; the flow makes more of that.
  const auto ghosts = state("periodic_ghosts");
  const auto wrap = state("periodic_wrap");
  for (std::size_t n = 0; n < wrap.size(); ++n)
    for (std::size_t i = 0; i < wrap[n].size(); ++i) ASSERT_NEAR(ghosts[n][i], wrap[n][i], 1e-12);
}

}  // namespace
