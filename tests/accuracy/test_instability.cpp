// The active instability of an aligned nematic, against the eigenvalue of its linear equations. About n = x, q = 1, for
// a wave vector k along n (bend) or across it (splay), with X = 2 + lambda for bend, 2 - lambda for splay, and the
// effective activity z = zeta for bend, -zeta for splay:
//
//   theta' = X/4 w - Gamma K k^2 theta,   M = mu + rho s / k^2,
//   s = z X / (2 M) - K k^2 (Gamma + [elastic stress] X^2 / (2 M)).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double length = 10.0;
constexpr double k = 2.0 * std::numbers::pi / length;
constexpr double mu = 2.0 / 3.0;
constexpr double gamma_of_q = 0.4;
constexpr double lambda = 0.7;
constexpr double elastic = 0.02;

struct Mode {
  bool bend;
  double activity;
  bool elastic_stress = false;
  [[nodiscard]] double x() const { return bend ? 2.0 + lambda : 2.0 - lambda; }
};

/// The larger root of the equation for s: the growth rate.
double growth_rate(const Mode& mode) {
  const double drive = (bool(mode.bend) ? 1.0 : -1.0) * mode.activity * mode.x() / 2.0;
  const double back = mode.elastic_stress ? elastic * k * k * mode.x() * mode.x() / 2.0 : 0.0;
  const double decay = gamma_of_q * elastic * k * k;
  // (s + decay) (mu + s / k^2) = drive - back
  const double b = mu * k * k + decay;
  const double c = k * k * (mu * decay - drive + back);
  return (-b + std::sqrt(b * b - 4.0 * c)) / 2.0;
}

/// Grows the mode from its own eigenvector, so that there is no transient, and measures how fast.
double measured_rate(const Mode& mode) {
  constexpr double amplitude = 1e-4;
  const double vorticity = (growth_rate(mode) + gamma_of_q * elastic * k * k) * 4.0 / mode.x() * amplitude;
  const char* const direction = mode.bend ? "1, 0" : "0, 1";
  CaseText text(length, 48);
  text.modes("director", fmt::format("[[{}, {}, 0.0]]", direction, amplitude))
      .modes("velocity", fmt::format("[[{}, {}, 0.0]]", direction, vorticity / (k * k)))
      .flow(mu)
      .nematic(gamma_of_q, lambda, elastic)
      .active(mode.activity);
  if (mode.elastic_stress) text.section("physics.elasticity", "type = \"elastic_stress\"");
  CaseRun run(text);
  const auto angle = [&] { return wave_of(run, run.field("order_tensor", 1), mode.bend, !mode.bend).cosine / 2.0; };
  run.run_to(4.0);
  const double early = angle();
  run.run_to(14.0);
  return std::log(angle() / early) / 10.0;
}

void expect_rate(const Mode& mode) {
  const double exact = growth_rate(mode);
  const double measured = measured_rate(mode);
  EXPECT_NEAR(measured / exact, 1.0, 0.02) << "grows at " << measured << " 1/s instead of " << exact;
}

TEST(Instability, FormulaGivesTheKnownRate) { EXPECT_NEAR(growth_rate({true, 0.05}), 0.07553, 2e-5); }

TEST(Instability, ExtensileBendGrows) { expect_rate({true, 0.05}); }

TEST(Instability, ContractileSplayGrows) { expect_rate({false, -0.05}); }

TEST(Instability, ExtensileSplayDecays) {
  ASSERT_LT(growth_rate({false, 0.01}), 0.0);
  expect_rate({false, 0.01});
}

TEST(Instability, ElasticStressSlowsBend) {
  ASSERT_LT(growth_rate({true, 0.05, true}), 0.7 * growth_rate({true, 0.05}));
  expect_rate({true, 0.05, true});
}

TEST(Instability, ElasticStressSlowsSplay) { expect_rate({false, -0.05, true}); }

}  // namespace
