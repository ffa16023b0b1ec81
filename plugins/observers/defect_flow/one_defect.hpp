#pragma once

#include <cmath>
#include <functional>

#include "defect_stokes_flow.hpp"
#include "fake_observer_context.hpp"

/// Scenes for tests: one defect in a box, and a flow that is known in its frame.
namespace mesogen::test {

constexpr double edge = 1.2;       // of the box, m
constexpr double spacing = 0.012;  // m

/// One defect, and a flow that is given in its frame.
struct OneDefect {
  double charge = 0.5;
  double orientation = 0.0;  // rad
  Complex place{0.607, 0.589};
  std::function<Complex(Complex)> velocity;
  std::function<double(Complex)> curl;

  [[nodiscard]] Complex in_frame(double x, double y) const {
    return (Complex(x, y) - place) * std::polar(1.0, -orientation);
  }
  void give_to(FakeObserverContext& context) const {
    // The director is radial along the orientation: angle = charge * polar angle + (1 - charge) * orientation.
    const auto tensor = [this](double x, double y) {
      const Complex z = Complex(x, y) - place;
      const double q = std::abs(z) / std::hypot(std::abs(z), 2.0 * spacing);
      return std::polar(q, 2.0 * (charge * std::arg(z) + (1.0 - charge) * orientation));
    };
    const auto lab = [this](double x, double y) { return velocity(in_frame(x, y)) * std::polar(1.0, orientation); };
    const auto none = [](double, double) { return 0.0; };
    context.set("order_tensor", {[=](double x, double y) { return tensor(x, y).real(); },
                                 [=](double x, double y) { return tensor(x, y).imag(); }});
    context.set("velocity", {[=](double x, double y) { return lab(x, y).real(); },
                             [=](double x, double y) { return lab(x, y).imag(); }});
    if (!curl) return;
    context.set("velocity_gradient", {none, [=, this](double x, double y) { return -0.25 * curl(in_frame(x, y)); },
                                      [=, this](double x, double y) { return 0.75 * curl(in_frame(x, y)); }, none});
  }
};

inline OneDefect formula(double charge, double orientation) {
  return {charge,
          orientation,
          {0.607, 0.589},
          [=](Complex z) { return flow(charge, z); },
          [=](Complex z) { return vorticity(charge, z); }};
}

inline OneDefect uniform_flow(double charge, double orientation) {
  return {charge, orientation, {0.607, 0.589}, [](Complex) { return Complex(0.3, -0.2); }, [](Complex) { return 0.7; }};
}

inline FakeObserverContext lattice() {
  const int across = static_cast<int>(std::lround(edge / spacing));
  return {across, across, edge, edge};
}

}  // namespace mesogen::test
