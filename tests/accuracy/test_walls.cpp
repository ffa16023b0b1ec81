// Flow and director between solid walls, against exact solutions.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double pi = std::numbers::pi;

/// A channel of 1 m between walls across y, `across` particles high and 12 wide.
CaseText channel(int across, const std::string& walls = "") {
  CaseText text(1.0, across);
  text.section("domain", fmt::format("size = [{}, 1.0]\nboundary = {{ type = \"walls\"{} }}", 12.0 / across, walls));
  return text;
}

/// Root of the mean square of values - exact(y), relative to that of the exact ones.
template <class Exact>
double error_of(CaseRun& run, const std::vector<double>& values, const Exact& exact) {
  const auto y = run.path(1);
  double wrong = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    wrong += std::pow(values[i] - exact(y[i]), 2);
    all += std::pow(exact(y[i]), 2);
  }
  return std::sqrt(wrong / all);
}

// Started from rest: u = f y (H - y) / (2 mu) - sum over odd n of 4 f H^2 / (mu pi^3 n^3) sin(n pi y / H) e^(-n^2 pi^2
// nu t / H^2)
double poiseuille_error(int across, const std::string& arrangement, const std::string& laplacian = "consistent",
                        double time = 1.0) {
  constexpr double force = 0.05;
  constexpr double viscosity = 0.1;
  CaseText text = channel(across);
  text.section("particles", fmt::format("spacing = {}\narrangement = \"{}\"", 1.0 / across, arrangement));
  text.kernel("quintic", laplacian)
      .flow(viscosity, "expected_speed = 0.0625")
      .section("physics.drive", "type = \"body_force\"\nforce = [0.05, 0.0]");
  CaseRun run(text);
  run.run_to(time);
  return error_of(run, run.field("velocity", 0), [&](double y) {
    double u = force * y * (1.0 - y) / (2.0 * viscosity);
    for (int n = 1; n < 100; n += 2)
      u -= 4.0 * force / (viscosity * std::pow(pi * n, 3)) * std::sin(n * pi * y) *
           std::exp(-n * n * pi * pi * viscosity * time);
    return u;
  });
}

// What is left at 1 s comes from the start, when the layer that the walls hold back is thinner than a spacing.
TEST(Poiseuille, ConvergesInSecondOrder) {
  const double coarse = poiseuille_error(20, "lattice");
  const double middle = poiseuille_error(40, "lattice");
  const double fine = poiseuille_error(80, "lattice");
  EXPECT_LT(coarse, 3e-3);
  EXPECT_LT(middle, 9e-4);
  EXPECT_LT(fine, 2.6e-4);
  EXPECT_GT(std::log2(middle / fine), 1.8) << middle << ", " << fine;
  // On a lattice the plain Laplacian has half as much error again, as long as the lattice lasts.
  EXPECT_LT(poiseuille_error(80, "lattice", "plain"), 5e-4);
}

// The velocity keeps its curvature behind the walls. Reflected straight, it was 1 % off.
TEST(Poiseuille, IsAsGoodAsExactOnceItIsSteady) {
  EXPECT_LT(poiseuille_error(20, "lattice", "consistent", 10.0), 5e-5);
}

// Disordered particles: the Laplacian's own error on them remains (see the architecture's weak spots).
TEST(Poiseuille, HoldsOnDisorderedParticles) { EXPECT_LT(poiseuille_error(40, "jittered"), 4e-3); }

// The upper wall moves: u = U y / H.
TEST(Couette, ReachesALinearProfile) {
  CaseText text = channel(20, ", velocity_low = -0.05, velocity_high = 0.1");
  text.flow(0.1, "expected_speed = 0.1");
  CaseRun run(text);
  run.run_to(8.0);
  EXPECT_LT(error_of(run, run.field("velocity", 0), [](double y) { return -0.05 + 0.15 * y; }), 1e-3);
}

/// Without flow the angle of an anchored director obeys dtheta/dt = Gamma K theta_yy. From 0.02 rad everywhere, held at
/// 0 by both walls: theta = sum over odd n of 0.08 / (n pi) sin(n pi y / H) e^(-n^2 pi^2 Gamma K t / H^2).
double error_of_relaxation(int across) {
  constexpr double elastic_constant = 0.01;
  constexpr double time = 10.0;
  CaseText text = channel(across, ", anchoring = \"planar\"");
  text.nematic(1.0, 0.0, elastic_constant).section("director", "type = \"uniform\"\nangle = 1.1459");
  CaseRun run(text);
  run.run_to(time);
  auto theta = run.field("order_tensor", 1);
  for (double& value : theta) value /= 2.0;
  return error_of(run, theta, [&](double y) {
    double exact = 0.0;
    for (int n = 1; n < 60; n += 2)
      exact += 0.08 / (n * pi) * std::sin(n * pi * y) * std::exp(-n * n * pi * pi * elastic_constant * time);
    return exact;
  });
}

TEST(AnchoredDirector, RelaxesAtTheExactRate) {
  const double coarse = error_of_relaxation(20);
  const double fine = error_of_relaxation(40);
  EXPECT_LT(fine, 3e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.5) << coarse << ", " << fine;
}

// Anchored along one wall and at 40 degrees at the other, the angle becomes linear, with q^2 = 1 - 4 K theta_y^2
// everywhere.
TEST(AnchoredDirector, ReachesTheLinearProfile) {
  constexpr double elastic_constant = 0.02;
  const double angle = 40.0 * pi / 180.0;
  const double order = std::sqrt(1.0 - 4.0 * elastic_constant * angle * angle);
  CaseText text = channel(20, fmt::format(", anchoring = \"angle\", angle_high = 40.0, order = {}", order));
  text.nematic(1.0, 0.0, elastic_constant).section("director", "type = \"uniform\"\nangle = 0.0");
  CaseRun run(text);
  run.run_to(50.0);
  auto theta = run.field("order_tensor", 1);
  auto q = run.field("order_tensor", 0);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double q12 = theta[i];
    theta[i] = 0.5 * std::atan2(q12, q[i]);
    q[i] = std::hypot(q[i], q12);
  }
  EXPECT_LT(error_of(run, theta, [&](double y) { return angle * y; }), 2e-3);
  EXPECT_LT(error_of(run, q, [&](double) { return order; }), 1e-3);
}

// An active fluid between walls flows by itself beyond a threshold (Voituriez, Joanny, Prost, Europhys. Lett. 70, 404
// (2005)). Director along the walls: theta ~ sin(2 pi y / H) grows at
//   s = -(1 - lambda / (2 q)) zeta q / mu - Gamma K (2 pi / H)^2
// without inertia (and without elastic stress). With it (rho = 1, mu = 0.3, Gamma = 1, K = 0.001, lambda = 0.5, q = 1,
// H = 1) the 1D equations
//   theta_t = (lambda / (4 q) - 1/2) u_y + Gamma K theta_yy,  rho u_t = mu u_yy - 2 zeta q theta_y,  theta = u = 0 at
//   0, H
// have the rates below, in units of Gamma K (2 pi / H)^2 (solved by Chebyshev collocation, all digits converged).
struct Activity {
  double per_threshold;
  double rate;
};
constexpr Activity beyond{3.0, 1.94327};
constexpr Activity below{0.5, -0.49750};
constexpr Activity extensile{-1.0, -2.02073};

/// Measured minus exact rate of growth, relative to what activity contributes to it.
double error_of_growth(int across, const Activity& activity) {
  constexpr double viscosity = 0.3;
  const double damping = 1e-3 * 4.0 * pi * pi;
  CaseText text = channel(across, ", anchoring = \"planar\"");
  text.flow(viscosity).nematic(1.0, 0.5, 1e-3).active(-activity.per_threshold * damping * viscosity / 0.75);
  text.modes("director", fmt::format("[[0, 1, 0.001, {}]]", -pi / 2.0));
  CaseRun run(text);
  const auto amplitude = [&] {
    const auto q12 = run.field("order_tensor", 1);
    const auto y = run.path(1);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += q12[i] * std::sin(2.0 * pi * y[i]);
    return sum;
  };
  run.run_to(2.0);  // the mean flow sets in at nu pi^2 / H^2 = 3 / s
  const double begun = amplitude();
  run.run_to(3.0);
  const double rate = std::log(amplitude() / begun);
  return (rate / damping - activity.rate) / std::abs(activity.per_threshold);
}

TEST(ActiveChannelLong, GrowthConvergesInSecondOrder) {
  const double coarse = std::abs(error_of_growth(16, beyond));
  const double fine = std::abs(error_of_growth(32, beyond));
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(std::log2(coarse / fine), 1.5) << coarse << ", " << fine;
}

TEST(ActiveChannel, FlowsByItselfOnlyBeyondTheThreshold) {
  EXPECT_NEAR(error_of_growth(24, beyond), 0.0, 0.07);
  EXPECT_NEAR(error_of_growth(24, below), 0.0, 0.07);
  EXPECT_NEAR(error_of_growth(24, extensile), 0.0, 0.07);
}

}  // namespace
