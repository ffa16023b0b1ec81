#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "contract_run.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen::testing {

namespace {

template <class Function>
constexpr bool is_general = false;
template <class Real>
constexpr bool is_general<sph::GeneralKernelFunction<Real>> = true;

/// Of 2 pi r W(r), by Simpson's rule: W as pair loops evaluate it.
template <class Real>
double integral(const sph::SmoothingKernel& kernel) {
  constexpr int intervals = 6000;  // a multiple of the pieces, so that knots fall on points
  double total = 0.0;
  sph::with_kernel_function<Real>(kernel, [&](const auto& function) {
    const double width = kernel.radius() / intervals;
    for (int n = 0; n <= intervals; ++n) {
      const double weight = n == 0 || n == intervals ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
      const double r = width * n;
      total += weight * width / 3.0 * 2.0 * std::numbers::pi * r * static_cast<double>(function.value(Real(r)));
    }
  });
  return total;
}

}  // namespace

void check_kernel(ContractRun& run) {
  // A shape that cannot be used is refused by the set-up, in words.
  run.check("its shape can be used", [&]() -> std::string {
    (void)run.harness().scene();
    return {};
  });
  run.check("its integral is 1, in single and double precision", [&]() -> std::string {
    const sph::SmoothingKernel kernel = run.harness().smoothing();
    for (const auto& [precision, value, tolerance] :
         {std::tuple{"double", integral<double>(kernel), 1e-8}, std::tuple{"single", integral<float>(kernel), 1e-4}})
      if (!(std::abs(value - 1.0) < tolerance))
        return fmt::format("it is {:.9g} in {} precision: a coefficient is too large for its sum", value, precision);
    return {};
  });
  run.check("the volume of a particle on a lattice is the square of the spacing, to 5 %", [&]() -> std::string {
    TestScene scene;
    scene.arrangement = "lattice";
    PluginHarness harness = run.harness(scene);
    const double ratio = harness.value("volume") / std::pow(scene.length / scene.across, harness.scene().dimension);
    if (std::abs(ratio - 1.0) < 0.05) return {};
    return fmt::format(
        "it is {:.4g} times that with h = 4/3 spacings: its support is too narrow, or its shape too "
        "pointed",
        ratio);
  });
  run.attempt("its form can be told", [&] {
    try {
      bool general = false;
      sph::with_kernel_function<double>(run.harness().smoothing(), [&](const auto& function) {
        general = is_general<std::decay_t<decltype(function)>>;
      });
      if (general)
        run.note(
            "pair loops take the general form of the kernel, which is slower; unrolled are the forms of the quintic "
            "spline and of Wendland C2, C4, C6");
    } catch (const Error&) {
      // Told above.
    }
  });
}

}  // namespace mesogen::testing
