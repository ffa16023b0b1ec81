#include "run/fewest_neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "case/arrangement.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

constexpr double least_determinant = 1e-5;
constexpr double jitter_of_motion = 0.25;  // spacings
constexpr int patch_width = 24;            // spacings
// From here on all kernels have enough: with a support of three spacings Wendland C6, the steepest, leaves 1e-3 at the
// largest jitter.
constexpr double always_enough = 3.0;  // spacings

double nearest_image(double distance) {
  if (distance > 0.5 * patch_width) return distance - patch_width;
  return distance < -0.5 * patch_width ? distance + patch_width : distance;
}

Arrangement patch_of(const Case& source, bool moving) {
  Case patch;
  patch.domain.size = {patch_width, patch_width};
  patch.particles = source.particles;
  patch.particles.spacing = 1.0;
  if (moving) {
    if (patch.particles.arrangement != "jittered") patch.particles.jitter = 0.0;
    patch.particles.arrangement = "jittered";
    patch.particles.jitter = std::max(patch.particles.jitter, jitter_of_motion);
  }
  return arrange(patch);
}

/// Sums over the neighbours of one particle, as sph/passes/fits.hpp has them; lengths in smoothing lengths.
class Moments {
 public:
  void add(double weight, double x, double y) {
    const std::array<double, 3> second = {x * x, x * y, y * y};
    for (std::size_t n = 0; n < 3; ++n) {
      alpha_[n] += weight * second[n];
      t_[n] += weight * second[n] * x;
      f_[n] += weight * second[n] * x * x;
    }
    t_[3] += weight * y * y * y;
    f_[3] += weight * y * y * y * x;
    f_[4] += weight * y * y * y * y;
  }

  [[nodiscard]] double of_gradient() const { return alpha_[0] * alpha_[2] - alpha_[1] * alpha_[1]; }

  /// Of F - T.B.T, B the inverse of the first matrix.
  [[nodiscard]] double of_quadratic() const {
    const double per = 1.0 / of_gradient();
    const double b[2][2] = {{alpha_[2] * per, -alpha_[1] * per}, {-alpha_[1] * per, alpha_[0] * per}};
    double s[3][3];
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) {
        s[r][c] = f_[r + c];
        for (std::size_t m = 0; m < 2; ++m)
          for (std::size_t n = 0; n < 2; ++n) s[r][c] -= t_[r + m] * b[m][n] * t_[c + n];
      }
    return s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) - s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
           s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
  }

 private:
  std::array<double, 3> alpha_{};
  std::array<double, 4> t_{};
  std::array<double, 5> f_{};
};

/// `h`: smoothing length in spacings, which are 1 here.
bool is_enough(const sph::KernelShape& shape, double h, const Arrangement& patch, bool quadratic) {
  const double scale = shape.normalisation(2) / (h * h);
  const double radius = h * shape.support();
  const auto& x = patch.position[0];
  const auto& y = patch.position[1];
  const auto for_neighbours = [&](std::size_t i, const auto& action) {
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double dx = nearest_image(x[j] - x[i]);
      const double dy = nearest_image(y[j] - y[i]);
      const double square = dx * dx + dy * dy;
      if (square < radius * radius) action(j, dx, dy, std::sqrt(square));
    }
  };
  std::vector<double> volume(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    double sum = 0.0;
    for_neighbours(i, [&](std::size_t, double, double, double r) { sum += scale * shape.value(r / h); });
    volume[i] = 1.0 / sum;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    Moments moments;
    for_neighbours(i, [&](std::size_t j, double dx, double dy, double r) {
      if (j == i) return;
      // |W'| / r in spacings; moments of lengths in h, but for those of the gradient in all, which have 1 as their sum.
      const double weight = volume[j] * std::abs(scale * shape.derivative(r / h)) * h / r;
      moments.add(weight, dx / h, dy / h);
    });
    if (!(moments.of_gradient() >= least_determinant)) return false;
    if (quadratic && !(moments.of_quadratic() >= least_determinant)) return false;
  }
  return true;
}

}  // namespace

std::string neighbours_problem(const Case& source, const sph::SmoothingKernel& kernel, const NeighbourNeeds& needs) {
  const double given = source.smoothing_length_ratio;
  const double support = kernel.shape.support();
  if (given * support >= always_enough) return {};
  const Arrangement patch = patch_of(source, needs.moving);
  if (is_enough(kernel.shape, given, patch, needs.quadratic)) return {};
  constexpr double fineness = 100.0;
  double least = std::ceil(std::max(given, 0.9 / support) * fineness);
  while (least < always_enough / support * fineness &&
         !is_enough(kernel.shape, least / fineness, patch, needs.quadratic))
    ++least;
  const std::string& arrangement = source.particles.arrangement;
  return "is " + rounded_text(given) + " particle spacings, which leaves a particle too few neighbours for " +
         (needs.quadratic ? "second derivatives" : "a gradient") + ": the kernel \"" + source.kernel.type +
         "\" needs at least " + rounded_text(least / fineness) + " here, where particles " +
         (arrangement == "jittered" ? "are jittered" : "start in a " + arrangement + " arrangement") +
         (needs.moving ? " and move" : "");
}

}  // namespace mesogen
