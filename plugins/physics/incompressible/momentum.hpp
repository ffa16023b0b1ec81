#pragma once

// The momentum equation of an incompressible fluid, mode by mode:
//
//   du/dt = -rate u + N,   rate = (mu k^2 + xi) / rho,   N = P (f / rho - div(u u)),
//
// P leaves of a force what has no divergence. N is known at the midpoints of the steps and taken to be linear in time
// between and beyond the last two; with that the equation is solved exactly (exponential time differencing, Cox and
// Matthews, J. Comput. Phys. 176, 430 (2002)). Fast modes follow their force at once, so no step is too long for
// viscosity, and the creeping flow without inertia, u = N / rate, is the same formula with nothing left of the start.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::incompressible {

using mesh::Complex;

struct Fluid {
  double density = 1.0;    ///< kg/m3
  double viscosity = 0.0;  ///< Pa s
  double friction = 0.0;   ///< force density per velocity, kg/(m3 s)
  bool inertia = true;
};

/// (1 - exp(-z)) / z, with decay = exp(-z) - 1.
inline double phi1(double z, double decay) { return z < 1e-8 ? 1.0 - z / 2.0 : -decay / z; }
/// (1 - phi1(z)) / z, with first = phi1(z).
inline double phi2(double z, double first) { return z < 1e-3 ? 0.5 - z / 6.0 + z * z / 24.0 : (1.0 - first) / z; }

template <int Dim>
class Momentum {
 public:
  using Kept = mesh::KeptModes<Dim>;
  using Modes = std::array<Complex*, Dim>;
  using WaveVector = typename Kept::WaveVector;

  Momentum(const Kept& modes, const Fluid& fluid)
      : modes_(modes),
        fluid_(fluid),
        velocity_(Dim * modes.mode_count()),
        older_(velocity_.size()),
        newer_(velocity_.size()) {}

  /// Leaves of a wave what has no divergence.
  static void project(const WaveVector& k, std::array<Complex, Dim>& u) {
    const double square = Kept::square(k);
    Complex along(0.0);
    for (int d = 0; d < Dim; ++d) along += k[d] * u[d];
    if (square == 0.0) return;
    for (int d = 0; d < Dim; ++d) u[d] -= k[d] / square * along;
  }

  /// A flow with these velocities begins; what divergence they have is taken out.
  void start(double time, const Modes& velocity) {
    times_ = {time, 0.0, 0.0, 0.0};
    modes_.for_each([&](std::size_t n, const WaveVector& k) {
      std::array<Complex, Dim> u{};
      for (int d = 0; d < Dim; ++d) u[d] = fluid_.inertia ? velocity[d][n] : Complex(0.0);
      project(k, u);
      for (int d = 0; d < Dim; ++d) component(velocity_, d)[n] = u[d];
    });
  }

  /// N (m/s2), not yet without divergence, at a time: the newest known from now on.
  void take(double time, const Modes& acceleration) {
    times_[older] = times_[newer];
    times_[newer] = time;
    times_[known] = std::min(times_[known] + 1.0, 2.0);
    modes_.for_each([&](std::size_t n, const WaveVector& k) {
      std::array<Complex, Dim> a{};
      for (int d = 0; d < Dim; ++d) a[d] = acceleration[d][n];
      project(k, a);
      for (int d = 0; d < Dim; ++d) {
        component(older_, d)[n] = component(newer_, d)[n];
        component(newer_, d)[n] = a[d];
      }
    });
  }

  /// The velocity at a time that is not before that of advance_to().
  void velocity_at(double time, const Modes& velocity) const {
    const double span = time - times_[start_of_step];
    const bool two = times_[known] > 1.0 && times_[newer] > times_[older];
    // N = newer + (newer - older) (t - t_newer) / (t_newer - t_older)
    const double per_time = two ? 1.0 / (times_[newer] - times_[older]) : 0.0;
    const double at_start = (times_[start_of_step] - times_[newer]) * per_time;
    modes_.for_each([&](std::size_t n, const WaveVector& k) {
      const double rate = (fluid_.viscosity * Kept::square(k) + fluid_.friction) / fluid_.density;
      // u = of_start u_start + constant N_start + slope dN/dt
      double of_start = 0.0;
      double constant = rate > 0.0 ? 1.0 / rate : 0.0;
      double slope = span * constant;
      if (fluid_.inertia) {
        const double z = rate * span;
        const double decay = std::expm1(-z);
        const double first = phi1(z, decay);
        of_start = 1.0 + decay;
        constant = span * first;
        slope = span * span * phi2(z, first);
      }
      const double of_newer = constant * (1.0 + at_start) + slope * per_time;
      const double of_older = -constant * at_start - slope * per_time;
      for (int d = 0; d < Dim; ++d)
        velocity[d][n] = of_start * component(velocity_, d)[n] + of_newer * component(newer_, d)[n] +
                         of_older * component(older_, d)[n];
    });
  }

  /// The state goes on to this time.
  void advance_to(double time) {
    velocity_at(time, {modes_of(velocity_)});
    times_[start_of_step] = time;
  }

  [[nodiscard]] const Complex* velocity(int d) const { return component(velocity_, d); }

  /// All that it remembers, for checkpoints.
  static constexpr int kept_count = 4;
  static constexpr const char* kept[kept_count] = {"velocity", "older force", "newer force", "times"};
  [[nodiscard]] std::span<double> numbers(int n) {
    std::vector<Complex>* const all[] = {&velocity_, &older_, &newer_};
    if (n == 3) return times_;
    return {reinterpret_cast<double*>(all[n]->data()), 2 * all[n]->size()};
  }
  static std::size_t count(const mesh::Grid<Dim>& grid, int n) { return n == 3 ? 4 : 2 * Dim * grid.mode_count(); }

 private:
  enum Time { start_of_step, older, newer, known };

  [[nodiscard]] Complex* component(std::vector<Complex>& all, int d) const {
    return all.data() + static_cast<std::size_t>(d) * modes_.mode_count();
  }
  [[nodiscard]] const Complex* component(const std::vector<Complex>& all, int d) const {
    return all.data() + static_cast<std::size_t>(d) * modes_.mode_count();
  }
  [[nodiscard]] Modes modes_of(std::vector<Complex>& all) const {
    Modes modes{};
    for (int d = 0; d < Dim; ++d) modes[d] = component(all, d);
    return modes;
  }
  const Kept& modes_;
  Fluid fluid_;
  std::vector<Complex> velocity_;  // at the start of the step, component after component
  std::vector<Complex> older_;     // N at the last midpoints
  std::vector<Complex> newer_;
  std::array<double, 4> times_{};  // of the three, s, and how many midpoints are known
};

}  // namespace mesogen::incompressible
