#include "operator_errors.hpp"

#include <cmath>
#include <numbers>

#include "case_run.hpp"
#include "particle_scene.hpp"

namespace mesogen::test {

OperatorErrors operator_errors(const Points& points, int waves, const OperatorChoice& choice) {
  ParticleScene::Options options;
  options.spacing = 1.0 / std::round(std::sqrt(static_cast<double>(points[0].size())));
  options.consistent_laplacian = choice.consistent_laplacian;
  options.precision = choice.precision;
  ParticleScene scene(options, points);
  const double k = 2.0 * std::numbers::pi * waves;
  const auto f = [k](double x, double y) { return std::sin(k * x + 0.3) * std::cos(k * y + 0.7); };
  scene.set(f);
  const auto along_x = scene.derived("f_gradient", 0);
  const auto along_y = scene.derived("f_gradient", 1);
  const auto laplacian = scene.derived("f_laplacian");
  double gradient_error = 0.0;
  double gradient_size = 0.0;
  double laplacian_error = 0.0;
  double laplacian_size = 0.0;
  for (std::size_t i = 0; i < laplacian.size(); ++i) {
    const double x = points[0][i];
    const double y = points[1][i];
    const double exact_x = k * std::cos(k * x + 0.3) * std::cos(k * y + 0.7);
    const double exact_y = -k * std::sin(k * x + 0.3) * std::sin(k * y + 0.7);
    const double exact = -2.0 * k * k * f(x, y);
    gradient_error += std::pow(along_x[i] - exact_x, 2) + std::pow(along_y[i] - exact_y, 2);
    gradient_size += exact_x * exact_x + exact_y * exact_y;
    laplacian_error += std::pow(laplacian[i] - exact, 2);
    laplacian_size += exact * exact;
  }
  return {std::sqrt(gradient_error / gradient_size), std::sqrt(laplacian_error / laplacian_size)};
}

Points points_after_turbulence(int across, int steps) {
  constexpr double length = 10.0;
  CaseText text(length, across);
  text.precision("single")
      .section("director", "type = \"perturbed\"\nangle = 22.9183\namplitude = 0.3\nseed = 1")
      .flow(0.2, "expected_speed = 0.4")
      .nematic(0.4, 0.7, 0.02)
      .active(0.08);
  CaseRun run(text);
  run.run_steps(steps);
  Points points;
  for (int d = 0; d < 2; ++d) {
    for (const double way : run.path(d)) {
      const double x = way / length - std::floor(way / length);
      points.at(static_cast<std::size_t>(d)).push_back(x < 1.0 ? x : 0.0);
    }
  }
  return points;
}

double fitted_order(const std::vector<double>& resolution, const std::vector<double>& error) {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  const auto n = static_cast<double>(error.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double a = std::log(resolution[i]);
    const double b = std::log(error[i]);
    x += a / n;
    y += b / n;
    xx += a * a / n;
    xy += a * b / n;
  }
  return -(xy - x * y) / (xx - x * x);
}

}  // namespace mesogen::test
