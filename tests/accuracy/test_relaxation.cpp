// A nematic at rest, without a flow plugin: it relaxes to the minimum of its free energy.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double length = 10.0;
constexpr double k = 2.0 * std::numbers::pi / length;
constexpr double gamma_of_q = 0.4;

CaseText at_rest(int across, double elastic_constant) {
  CaseText text(length, across);
  text.nematic(gamma_of_q, 0.7, elastic_constant).read("\"order_tensor_gradient\", \"volume\", \"elastic_energy\"");
  return text;
}

/// Measured over exact rate at which a small wave of the director decays, minus 1.
double error_of_decay(int across) {
  constexpr double elastic_constant = 0.5;
  CaseText text = at_rest(across, elastic_constant);
  text.modes("director", "[[1, 0, 1e-4, 0.3]]").section("time", "end = 1e6\nstep = 0.01");
  CaseRun run(text);
  const auto amplitude = [&] {
    const Wave wave = wave_of(run, run.field("order_tensor", 1), 1, 0);
    return std::hypot(wave.cosine, wave.sine);
  };
  const double begun = amplitude();
  const double end = 1.0 / (gamma_of_q * elastic_constant * k * k);
  run.run_to(end);
  return std::log(begun / amplitude()) - 1.0;
}

TEST(Relaxation, WaveOfTheDirectorDecaysAtTheExactRateInSecondOrder) {
  const double coarse = error_of_decay(16);
  const double fine = error_of_decay(32);
  EXPECT_LT(std::abs(fine), 0.02);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << "errors " << coarse << ", " << fine;
}

TEST(Relaxation, NothingThatRestsIsComputedTwice) {
  CaseText text = at_rest(16, 0.5);
  text.modes("director", "[[1, 0, 0.1, 0.3]]");
  CaseRun run(text);
  run.run_steps(25);
  EXPECT_EQ(run.state().neighbourhood.sortings(), 1);
  bool found = false;
  for (const auto& share : run.stepper().shares()) {
    if (share.title == "framework: volume") {
      EXPECT_EQ(share.runs, 1);
    }
    if (share.title == "framework: order_tensor_laplacian") {
      EXPECT_EQ(share.runs, 26);  // at the start, then once a step
      found = true;
    }
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(run.path(0), run.setup().arrangement.position[0]);
}

// q' = Gamma (-A - 2 C q^2) q about q = 1: the deviation falls at the rate 2 |A| Gamma, from either side.
TEST(Relaxation, OrderReachesItsEquilibriumAtTheExactRate) {
  for (const double begun : {0.999, 1.001}) {
    CaseText text = at_rest(16, 0.02);
    text.section("director", fmt::format("type = \"uniform\"\nangle = 30.0\norder = {}", begun))
        .section("time", "end = 1e6\nstep = 0.005");
    CaseRun run(text);
    const auto order = [&] { return run.observe("nematic_statistics", "mean_order"); };
    const double before = order() - 1.0;
    run.run_to(2.0);
    EXPECT_NEAR(std::log(before / (order() - 1.0)) / 2.0, 2.0 * gamma_of_q, 0.004) << "from q = " << begun;
    run.run_to(40.0);
    EXPECT_NEAR(order(), 1.0, 1e-10);
    EXPECT_NEAR(run.observe("nematic_statistics", "mean_director_angle"), std::numbers::pi / 6.0, 1e-12);
  }
}

TEST(Relaxation, FreeEnergyNeverRises) {
  CaseText text = at_rest(32, 0.1);
  text.section("director",
               "type = \"modes\"\norder = 0.7\nmodes = [[1, 0, 0.8, 0.3], [0, 2, 0.5, 1.1], [2, -1, 0.4, 0.2], [3, 3, "
               "0.3, 2.0]]");
  CaseRun run(text);
  const double begun = run.observe("nematic_statistics", "free_energy");
  double last = begun;
  while (run.time() < 100.0) {
    run.run_steps(5);
    const double now = run.observe("nematic_statistics", "free_energy");
    ASSERT_LE(now, last + 1e-12 * std::abs(last)) << "at t = " << run.time();
    last = now;
  }
  // The least there is: q = 1 everywhere, -1/2 Pa. The first mode is all that is left above it.
  const double least = -0.5 * length * length;
  EXPECT_LT(last - least, 0.05 * (begun - least));
  EXPECT_GE(last, least * (1.0 + 1e-12));
}

// dF = -2 sum_i V (H11 dQ11 + H12 dQ12), as particles find H: also for noise from particle to particle and for the jump
// at a wall across the director, of which the square of a gradient sees a tenth.
TEST(Relaxation, FreeEnergyFallsByWhatTheMolecularFieldDoes) {
  const std::string noise = "type = \"perturbed\"\namplitude = 0.3\nseed = 3";
  for (const bool walls : {false, true}) {
    CaseText text = at_rest(24, 0.5);
    text.read("\"order_tensor_gradient\", \"volume\", \"elastic_energy\", \"molecular_field\"")
        .section("director", walls ? "type = \"uniform\"" : noise)
        .section("time", "end = 1e6\nstep = 1e-4");
    if (walls)
      text.section("domain", "size = [10.0, 10.0]\nboundary = { type = \"walls\", anchoring = \"homeotropic\" }");
    CaseRun run(text);
    std::vector<double> q[2][2];  // before and after, components
    std::vector<double> h[2][2];
    double energy[2];
    for (const std::size_t when : {0, 1}) {
      run.run_steps(1);
      energy[when] = run.observe("nematic_statistics", "free_energy");
      for (const int c : {0, 1}) {
        q[when][c] = run.field("order_tensor", c);
        h[when][c] = run.field("molecular_field", c);
      }
    }
    double work = 0.0;
    for (const int c : {0, 1})
      for (std::size_t i = 0; i < q[0][c].size(); ++i) work -= (h[0][c][i] + h[1][c][i]) * (q[1][c][i] - q[0][c][i]);
    work *= length * length / static_cast<double>(q[0][0].size());
    EXPECT_LT(work, 0.0);
    EXPECT_NEAR((energy[1] - energy[0]) / work, 1.0, 0.01) << (walls ? "walls" : "noise");
  }
}

// The volumes of the kernel miss the box where particles lie unevenly; those of the free energy do not.
TEST(Relaxation, FreeEnergyIsOfTheWholeBox) {
  CaseText text = at_rest(24, 0.5);
  text.section("particles", "spacing = 0.4166666666666667\narrangement = \"jittered\"\njitter = 0.3\nseed = 3")
      .section("director", "type = \"uniform\"");
  CaseRun run(text);
  double filled = 0.0;
  for (const double volume : run.field("volume")) filled += volume;
  EXPECT_GT(std::abs(filled / (length * length) - 1.0), 1e-3);
  EXPECT_NEAR(run.observe("nematic_statistics", "free_energy"), -0.5 * length * length, 1e-10);
}

}  // namespace
