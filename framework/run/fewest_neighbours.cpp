#include "run/fewest_neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "case/arrangement.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

constexpr double least_determinant = 1e-5;
constexpr double jitter_of_motion = 0.25;  // spacings
constexpr double particles_of_patch = 24 * 24;
// From here on all kernels have enough: with a support of three spacings Wendland C6, the steepest, leaves 1e-3 at the
// largest jitter.
constexpr double always_enough = 3.0;  // spacings

/// Edge of the patch in spacings: an even number, for the rows of a hexagonal arrangement.
int patch_width(int dimension) {
  return 2 * static_cast<int>(std::lround(std::pow(particles_of_patch, 1.0 / dimension) / 2.0));
}

Arrangement patch_of(const Case& source, bool moving) {
  Case patch;
  patch.domain.size.assign(source.domain.size.size(), patch_width(source.dimension()));
  patch.particles = source.particles;
  patch.particles.spacing = 1.0;
  if (moving) {
    if (patch.particles.arrangement != "jittered") patch.particles.jitter = 0.0;
    patch.particles.arrangement = "jittered";
    patch.particles.jitter = std::max(patch.particles.jitter, jitter_of_motion);
  }
  return arrange(patch);
}

template <int Dim>
using Vector = std::array<double, static_cast<std::size_t>(Dim)>;

double nearest_image(double distance, double width) {
  if (distance > 0.5 * width) return distance - width;
  return distance < -0.5 * width ? distance + width : distance;
}

/// The sums over the neighbours of one particle whose matrices sph/passes/fits.hpp inverts, as one matrix of moments
/// of (r, rr); lengths in smoothing lengths. Eliminating r leaves F - T.B.T, with B the inverse of the first matrix.
template <int Dim>
class Moments {
 public:
  void add(double weight, const Vector<Dim>& r) {
    std::array<double, size> basis{};
    std::size_t n = 0;
    for (const double x : r) basis[n++] = x;
    for (std::size_t a = 0; a < r.size(); ++a)
      for (std::size_t b = a; b < r.size(); ++b) basis[n++] = r[a] * r[b];
    for (std::size_t row = 0; row < size; ++row)
      for (std::size_t column = 0; column < size; ++column) matrix_[row][column] += weight * basis[row] * basis[column];
  }

  struct Determinants {
    double of_gradient = 1.0;
    double of_quadratic = 1.0;
  };
  /// The matrix is symmetric and has no negative eigenvalue: it needs no pivoting.
  [[nodiscard]] Determinants determinants() const {
    Determinants result;
    auto left = matrix_;
    for (std::size_t n = 0; n < size; ++n) {
      (n < linear ? result.of_gradient : result.of_quadratic) *= left[n][n];
      for (std::size_t row = n + 1; row < size; ++row)
        for (std::size_t column = n + 1; column < size; ++column)
          left[row][column] -= left[row][n] * left[n][column] / left[n][n];
    }
    return result;
  }

 private:
  static constexpr std::size_t linear = Dim;
  static constexpr std::size_t size = linear + linear * (linear + 1) / 2;
  std::array<std::array<double, size>, size> matrix_{};
};

/// `h`: smoothing length in spacings, which are 1 here.
template <int Dim>
bool is_enough(const sph::KernelShape& shape, double h, const Arrangement& patch, bool quadratic) {
  const double scale = shape.normalisation(Dim) / std::pow(h, Dim);
  const double radius = h * shape.support();
  const double width = patch_width(Dim);
  const auto count = static_cast<std::size_t>(patch.count);
  const auto for_neighbours = [&](std::size_t i, const auto& action) {
    for (std::size_t j = 0; j < count; ++j) {
      Vector<Dim> apart{};
      double square = 0.0;
      for (std::size_t d = 0; d < apart.size(); ++d) {
        apart[d] = nearest_image(patch.position[d][j] - patch.position[d][i], width);
        square += apart[d] * apart[d];
      }
      if (square < radius * radius) action(j, apart, std::sqrt(square));
    }
  };
  std::vector<double> volume(count);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for_neighbours(i, [&](std::size_t, const Vector<Dim>&, double r) { sum += scale * shape.value(r / h); });
    volume[i] = 1.0 / sum;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Moments<Dim> moments;
    for_neighbours(i, [&](std::size_t j, Vector<Dim> apart, double r) {
      if (j == i) return;
      for (double& x : apart) x /= h;
      // |W'| / r in spacings; moments of lengths in h, but for those of the gradient in all, which have 1 as their sum.
      moments.add(volume[j] * std::abs(scale * shape.derivative(r / h)) * h / r, apart);
    });
    const auto [of_gradient, of_quadratic] = moments.determinants();
    if (!(of_gradient >= least_determinant)) return false;
    if (quadratic && !(of_quadratic >= least_determinant)) return false;
  }
  return true;
}

}  // namespace

std::string neighbours_problem(const Case& source, const sph::SmoothingKernel& kernel, const NeighbourNeeds& needs) {
  const double given = source.smoothing_length_ratio;
  const double support = kernel.shape.support();
  if (given * support >= always_enough) return {};
  const Arrangement patch = patch_of(source, needs.moving);
  const auto suffices = [&](double smoothing_length) {
    return dispatch(source.dimension(),
                    [&]<int Dim>() { return is_enough<Dim>(kernel.shape, smoothing_length, patch, needs.quadratic); });
  };
  if (suffices(given)) return {};
  constexpr double fineness = 100.0;
  double least = std::ceil(std::max(given, 0.9 / support) * fineness);
  while (least < always_enough / support * fineness && !suffices(least / fineness)) ++least;
  const std::string& arrangement = source.particles.arrangement;
  return "is " + rounded_text(given) + " particle spacings, which leaves a particle too few neighbours for " +
         (needs.quadratic ? "second derivatives" : "a gradient") + ": the kernel \"" + source.kernel.type +
         "\" needs at least " + rounded_text(least / fineness) + " here, where particles " +
         (arrangement == "jittered" ? "are jittered" : "start in a " + arrangement + " arrangement") +
         (needs.moving ? " and move" : "");
}

}  // namespace mesogen
