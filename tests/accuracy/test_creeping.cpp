// Creeping flow by wcsph, whose momentum has an artificial density: against exact Stokes flow between walls, in SI
// units of an experiment, and against the pseudo-spectral Stokes solution of the benchmark.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double pi = std::numbers::pi;

constexpr double width = 20e-6;             // m
constexpr double viscosity = 0.1;           // Pa s
constexpr double elastic_constant = 4e-12;  // N
constexpr double alignment = 0.7;
constexpr int across = 24;

// Director across the channel, extensile: Q12 = sin(2 pi y / L) grows above this activity (Gamma = 1).
const double threshold = 4.0 * pi * pi * elastic_constant * viscosity / (width * width * (1.0 + alignment / 2.0));

/// A film of 1000 kg/m3 in micrometres, without inertia.
CaseText channel(double activity, const std::string& precision, const std::string& flow = "") {
  CaseText text(width, across);
  text.section("domain", fmt::format("size = [{:.17g}, {:.17g}]\n"
                                     "boundary = {{ type = \"walls\", anchoring = \"homeotropic\" }}",
                                     width / 2.0, width))
      .precision(precision)
      .section("physics.flow",
               fmt::format("type = \"wcsph\"\ndensity = 1000.0\nviscosity = {}\ninertia = false\n{}", viscosity, flow))
      .nematic(1.0, alignment, elastic_constant)
      .active(activity)
      .section("director",
               fmt::format("type = \"modes\"\nangle = {:.17g}\nmodes = [[0, 1, 0.01, {:.17g}]]", pi / 2.0, -pi / 2.0));
  return text;
}

/// mu u' = zeta (Q12 - <Q12>), u = 0 at both walls, from the columns of particles: by rows, from wall to wall.
double distance_from_stokes(CaseRun& run, double activity) {
  const auto q12 = run.field("order_tensor", 1);
  const auto u = run.field("velocity", 0);
  std::vector<double> slope(across);
  std::vector<double> moved(across);
  const std::size_t columns = q12.size() / across;
  for (std::size_t i = 0; i < q12.size(); ++i) {
    slope[i / columns] += q12[i] / static_cast<double>(columns);
    moved[i / columns] += u[i] / static_cast<double>(columns);
  }
  double mean = 0.0;
  for (const double q : slope) mean += q / across;
  // The velocity at a row: that at the face below it, and half a spacing on.
  const double step = width / across * activity / viscosity;
  double face = 0.0;
  double wrong = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < across; ++n) {
    const double exact = face + step / 2.0 * (slope[n] - mean);
    face += step * (slope[n] - mean);
    wrong += std::pow(moved[n] - exact, 2);
    all += exact * exact;
  }
  return std::sqrt(wrong / all);
}

TEST(CreepingChannel, InMicrometresFollowsItsStressAsStokesFlowDoes) {
  const double activity = 2.0 * threshold;
  for (const char* const precision : {"single", "double"}) {
    CaseRun run(channel(activity, precision));
    run.run_to(5.0);
    EXPECT_LT(distance_from_stokes(run, activity), 0.02) << precision;
  }
}

// s = (1 + lambda/2) zeta / mu - Gamma K (2 pi / L)^2
TEST(CreepingChannel, GrowsAtTheRateOfStokesFlow) {
  const double activity = 2.0 * threshold;
  const double exact =
      (1.0 + alignment / 2.0) * activity / viscosity - elastic_constant * std::pow(2.0 * pi / width, 2);
  for (const auto& [flow, most] : {std::pair{"", 0.05}, {"relaxation_ratio = 60", 0.02}}) {
    CaseRun run(channel(activity, "double", flow));
    const auto largest = [&] {
      const auto q12 = run.field("order_tensor", 1);
      return *std::max_element(q12.begin(), q12.end());
    };
    run.run_to(1.0);
    const double before = largest();
    run.run_to(3.0);
    const double rate = std::log(largest() / before) / 2.0;
    EXPECT_NEAR(rate / exact, 1.0, most) << flow;
  }
}

TEST(CreepingBenchmark, FollowsTheSpectralStokesSolution) {
  CaseText text(10.0, 36);
  text.modes("director",
             "[[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1], [1, 1, 0.02, 2.0], [2, -1, 0.02, 0.7], [3, 1, 0.01, 1.9]]")
      .flow(2.0 / 3.0, "inertia = false")
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .read("\"velocity\", \"order_tensor_gradient\"");
  CaseRun run(text);
  for (const auto& [time, v_rms] : {std::pair{10.0, 0.022271}, {20.0, 0.051984}, {30.0, 0.086556}}) {
    run.run_to(time);
    EXPECT_NEAR(run.observe("flow_statistics", "v_rms") / v_rms, 1.0, 0.03) << "t = " << time;
  }
}

}  // namespace
