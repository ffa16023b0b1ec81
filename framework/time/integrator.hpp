#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "particles/field_loops.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/state.hpp"
#include "time/stages.hpp"

namespace mesogen {

/// What a step found while it moved the particles.
struct Motion {
  double fastest = 0.0;             ///< largest speed, m/s
  double largest_acceleration = 0;  ///< m/s2
  bool finite = true;               ///< was every advanced number finite?
  /// No particle is farther than this from where it was sorted, m.
  double farthest = std::numeric_limits<double>::infinity();
};

/// How `predicted` fields (velocity, order tensor) and positions are advanced. Both evaluate the rates once a step, at
///
///     u* = u + dt/2 a (of the last midpoint),  r* = r + dt/2 u*
///
enum class TimeScheme {
  /// u = u* + dt/2 a,  r = r* + dt/2 u: the published scheme (u = u + dt/2 a, as Saghatchi, Kolukisa and Yildiz print
  /// it, would lose half of a). u* goes from midpoint to midpoint by explicit Euler: first order for what depends on
  /// the field itself, stable to -2 of rate x dt.
  half_steps,
  /// u = u + dt a,  r = r + dt u*: u* is extrapolated, so this is the second-order Adams-Bashforth method seen from its
  /// midpoints; stable to -1.
  midpoint,
};

/// Advances positions and integrated fields: see TimeScheme. `midpoint` fields (see Advance) take f = f + dt df/dt in
/// either scheme, and the shift is added to positions at the end of the step. Sums are kept in double.
///
/// Stabilised steps, with TimeScheme::midpoint, take linear terms of some fields in stages (see Stages). The velocity u
/// is then advanced first, by its mean rate over the step:
///
///     r* = r + dt/2 u,   u' = u + dt (mean rate),   r' = r* + dt/2 u'
///
/// Passes that its acceleration needs see u, all others the mean (u + u') / 2.
///
/// A velocity that passes bring from step to step (Advance::by_passes) is no sum of rates: r* = r + dt/2 u with the
/// velocity that the last step left, r = r + dt u with the one that passes made at the midpoint (the explicit midpoint
/// method).
class MESOGEN_EXPORT Integrator {
 public:
  /// `stages`: of stabilised steps; it must outlive the integrator.
  Integrator(State& state, const Catalogue& catalogue, const Transport& transport, TimeScheme scheme, Stages& stages);

  /// Completes the rates at the start of a run by the terms that are taken in stages.
  void start();
  /// `motion`: what the last step found.
  void predict(double step_size, const Motion& motion);
  /// In a stabilised step, once the acceleration is known; does nothing to any other velocity.
  void advance_velocity(double step_size);
  [[nodiscard]] bool stages_velocity() const;
  /// Only asks for it; motion() tells what the step found, once the backend has waited.
  void correct(double step_size);
  [[nodiscard]] Motion motion();

  /// What a step left where passes advance the velocity, once they have.
  void look(double step_size, Motion& motion) const;

  /// Largest magnitude of the rates of velocity now; 0 if nothing moves. Where passes advance the velocity, of what
  /// drives it.
  [[nodiscard]] double largest_acceleration() const;
  /// Largest speed now; 0 if nothing moves.
  [[nodiscard]] double fastest() const;
  [[nodiscard]] bool velocity_by_passes() const { return way_to_midpoint_ != nullptr; }
  [[nodiscard]] bool moves() const { return velocity_ != nullptr && !fixed_; }
  /// The fluid's, and its rate; null if nothing flows.
  [[nodiscard]] const Field* velocity() const { return velocity_; }
  [[nodiscard]] const Field* acceleration() const { return acceleration_; }
  /// The largest length of an advanced field that the last step left.
  [[nodiscard]] double largest(std::string_view field) const;

  /// An advanced field and particle that is not finite, for the error; empty if all are.
  struct Bad {
    std::string field;
    Index particle = -1;
  };
  [[nodiscard]] Bad find_bad() const;

 private:
  struct Advanced {
    Field* field;
    Field* rate;
    bool predicted;
    Field* start;                  // with TimeScheme::midpoint: a predicted field at the start of the step
    const LinearTerms* in_stages;  // null: none
    double largest = 0.0;
    exec::Reduction found{};  // the largest, and that of the rate, squared
  };
  [[nodiscard]] const Advanced* staged_velocity() const;
  [[nodiscard]] double prediction(const Advanced& one, double step_size) const;
  // f = from + by * rate.
  void advance(const Advanced& one, Field& from, double by);
  // The same at the end of a step, where somebody looks.
  void advance_to_end(Advanced& one, double by);
  template <class Real>
  [[nodiscard]] exec::AdvanceArguments<Real> advancing(const Advanced& one, Field& from, double by) const;
  template <class Real>
  [[nodiscard]] exec::MoveArguments<Real> moving(double by, double shift_by) const;
  // With a velocity that passes made, from where the step started.
  template <class Real>
  [[nodiscard]] exec::MoveByPassesArguments<Real> moving_by_passes(double step_size, bool to_midpoint) const;
  template <class Arguments>
  void set_position(Arguments& arguments) const;
  void move_to_midpoint(double step_size, const Motion& motion);
  void move_to_end(double step_size);
  template <class Real>
  void look(double step_size, Motion& motion) const;

  State& state_;
  TimeScheme scheme_;
  Stages& stages_;
  bool fixed_;  // particles stay
  std::vector<Advanced> advanced_;
  Field* velocity_ = nullptr;
  Field* acceleration_ = nullptr;
  Field* drive_ = nullptr;
  Field* shift_ = nullptr;
  Field* way_to_midpoint_ = nullptr;         // of each particle, m; where passes advance the velocity
  std::optional<exec::Reduction> farthest_;  // from where particles were sorted, squared; nothing where nothing moves
  std::optional<exec::Reduction> fastest_;   // where passes advance the velocity
};

}  // namespace mesogen
