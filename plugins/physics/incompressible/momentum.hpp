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
#include <span>

#include "mesogen/mesh/mode_loop.hpp"
#include "momentum_modes.hpp"
#include "vector_modes.hpp"

namespace mesogen::incompressible {

template <int Dim>
class Momentum {
 public:
  using Loop = mesh::ModeLoop<Dim>;
  using Modes = std::array<Complex*, Dim>;
  using ConstModes = std::array<const Complex*, Dim>;

  Momentum(const mesh::Grid<Dim>& grid, const Fluid& fluid)
      : fluid_(fluid),
        velocity_(grid.mode_count(), nullptr),
        older_(grid.mode_count(), nullptr),
        newer_(grid.mode_count(), nullptr) {}

  /// All modes lie there from now on.
  void move_to(exec::DeviceMemory* memory) {
    for (auto* const all : {&velocity_, &older_, &newer_}) all->move_to(memory);
  }

  /// A flow with these velocities begins; what divergence they have is taken out.
  void start(const Loop& modes, double time, const ConstModes& velocity) {
    times_ = {time, 0.0, 0.0, 0.0};
    modes.for_each(StartFlow<Dim>{velocity, velocity_.write(), fluid_.inertia});
  }

  /// N (m/s2), not yet without divergence, at a time: the newest known from now on.
  void take(const Loop& modes, double time, const ConstModes& acceleration) {
    times_[older] = times_[newer];
    times_[newer] = time;
    times_[known] = std::min(times_[known] + 1.0, 2.0);
    modes.for_each(TakeForce<Dim>{acceleration, older_.write(), newer_.write()});
  }

  /// The velocity at a time that is not before that of advance_to().
  void velocity_at(const Loop& modes, double time, const Modes& velocity) const {
    AdvanceModes<Dim> advance{
        fluid_, time - times_[start_of_step], 0.0, 0.0, velocity_.read(), older_.read(), newer_.read(), velocity};
    // N = newer + (newer - older) (t - t_newer) / (t_newer - t_older)
    if (times_[known] > 1.0 && times_[newer] > times_[older]) advance.per_time = 1.0 / (times_[newer] - times_[older]);
    advance.at_start = (times_[start_of_step] - times_[newer]) * advance.per_time;
    modes.for_each(advance);
  }

  /// The state goes on to this time.
  void advance_to(const Loop& modes, double time) {
    velocity_at(modes, time, velocity_.write());
    times_[start_of_step] = time;
  }

  [[nodiscard]] ConstModes velocity() const { return velocity_.read(); }

  /// All that it remembers, for checkpoints.
  static constexpr int kept_count = 4;
  static constexpr const char* kept[kept_count] = {"velocity", "older force", "newer force", "times"};
  [[nodiscard]] std::span<double> numbers(int n) {
    VectorModes<Dim>* const all[] = {&velocity_, &older_, &newer_};
    if (n == 3) return times_;
    return all[n]->numbers();
  }
  static std::size_t count(const mesh::Grid<Dim>& grid, int n) { return n == 3 ? 4 : 2 * Dim * grid.mode_count(); }

 private:
  enum Time { start_of_step, older, newer, known };

  Fluid fluid_;
  VectorModes<Dim> velocity_;  // at the start of the step
  VectorModes<Dim> older_;     // N at the last midpoints
  VectorModes<Dim> newer_;
  std::array<double, 4> times_{};  // of the three, s, and how many midpoints are known
};

}  // namespace mesogen::incompressible
