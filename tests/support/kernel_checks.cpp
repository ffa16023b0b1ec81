#include "kernel_checks.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "mesogen/sph/kernel_function.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {

namespace {

using std::numbers::pi;

/// Integral of a function over [from, to], exact for polynomials up to degree 31: Gauss's rule of 16 points, the roots
/// of the Legendre polynomial found by Newton's iteration.
double integrate(const std::function<double(double)>& function, double from, double to) {
  constexpr int points = 16;
  double total = 0.0;
  for (int k = 0; k < points; ++k) {
    double x = std::cos(pi * (k + 0.75) / (points + 0.5));
    double slope = 1.0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double last = 1.0;
      double now = x;
      for (int n = 2; n <= points; ++n) {
        const double next = ((2 * n - 1) * x * now - (n - 1) * last) / n;
        last = now;
        now = next;
      }
      slope = points * (x * now - last) / (x * x - 1.0);
      x -= now / slope;
    }
    const double weight = 2.0 / ((1.0 - x * x) * slope * slope);
    total += weight * function(0.5 * (from + to) + 0.5 * (to - from) * x);
  }
  return 0.5 * (to - from) * total;
}

template <class Function>
constexpr bool is_general = false;
template <class Real>
constexpr bool is_general<sph::GeneralKernelFunction<Real>> = true;

sph::SmoothingKernel smoothing_kernel(const std::string& kernel, int dimension) {
  constexpr double h = 0.37;
  const auto shape = shape_of(kernel);
  return {shape, h, shape.normalisation(dimension) / std::pow(h, dimension)};
}

template <class Real>
void expect_unrolled_form(const std::string& kernel, double tolerance) {
  const sph::SmoothingKernel smoothing = smoothing_kernel(kernel, 2);
  const double h = smoothing.smoothing_length;
  const double scale = smoothing.scale;
  const double peak = scale * smoothing.shape.value(0.0);
  sph::with_kernel_function<Real>(smoothing, [&](const auto& function) {
    EXPECT_FALSE(is_general<std::decay_t<decltype(function)>>) << kernel << " takes the slow general form";
    for (int n = 0; n <= 200; ++n) {
      const auto r = static_cast<Real>(1.1 * smoothing.radius() * n / 200);
      const double q = static_cast<double>(r) / h;
      ASSERT_NEAR(static_cast<double>(function.value(r)), scale * smoothing.shape.value(q), tolerance * peak);
      ASSERT_NEAR(static_cast<double>(function.derivative(r)), scale / h * smoothing.shape.derivative(q),
                  tolerance * peak / h);
    }
  });
}

}  // namespace

sph::KernelShape shape_of(const std::string& kernel) {
  sph::KernelShape shape = built_plugins().make_kernel(kernel, 2)->shape();
  EXPECT_EQ(shape.problem(), "");
  return shape;
}

void expect_normalisation(const std::string& kernel, double in_2d, double in_3d) {
  const auto shape = shape_of(kernel);
  EXPECT_NEAR(shape.normalisation(2), in_2d, 1e-13 * in_2d);
  EXPECT_NEAR(shape.normalisation(3), in_3d, 1e-13 * in_3d);
}

void expect_unit_integral(const std::string& kernel) {
  for (const int dimension : {2, 3}) {
    const sph::SmoothingKernel smoothing = smoothing_kernel(kernel, dimension);
    double integral = 0.0;
    sph::with_kernel_function<double>(smoothing, [&](const auto& function) {
      double outer = smoothing.radius();
      // Between two knots the kernel is one polynomial, which the rule integrates exactly.
      for (std::size_t k = 0; k < smoothing.shape.pieces.size(); ++k) {
        const bool last = k + 1 == smoothing.shape.pieces.size();
        const double inner = last ? 0.0 : smoothing.shape.pieces[k + 1].knot * smoothing.smoothing_length;
        integral +=
            integrate([&](double r) { return function.value(r) * (dimension == 2 ? 2.0 * pi * r : 4.0 * pi * r * r); },
                      inner, outer);
        outer = inner;
      }
    });
    EXPECT_NEAR(integral, 1.0, 1e-12) << kernel << " in " << dimension << " dimensions";
  }
}

void expect_unrolled_form(const std::string& kernel) {
  expect_unrolled_form<float>(kernel, 1e-4);
  expect_unrolled_form<double>(kernel, 1e-12);
}

}  // namespace mesogen::test
