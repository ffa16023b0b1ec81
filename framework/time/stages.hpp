#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/linear_terms.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// The mean rate of a field over a step in which its linear terms L take part and all else, F, is frozen:
///
///     df/dt = F + L f   from t to t + dt
///
/// by RKL2, a Runge-Kutta-Legendre method of second order (Meyer, Balsara, Aslam, J. Comput. Phys. 257, 594 (2014)). s
/// stages are stable for (s^2 + s - 2) / 4 times the longest stable explicit step. F takes part in each stage, so a
/// balance of F and L f is kept however stiff L is.
///
/// Stages work on the increment of the field since the start of the step: numbers of the run's precision lose nothing
/// of a field that hardly changes.
class MESOGEN_EXPORT Stages {
 public:
  /// All of these must outlive it. `eigenvalue`: largest of minus the Laplacian on a lattice, 1/m2.
  Stages(State& state, DerivedFields& derived, const std::vector<LinearTerms>& staged, double eigenvalue);

  /// The terms of a field that are taken in stages; null if there are none.
  [[nodiscard]] const LinearTerms* of(std::string_view field) const;
  /// Takes the terms of a field into account. On entry the field is as at the start of the step and the rate is F; on
  /// exit the rate is the mean one. With a step of 0, F + L f.
  void take(const LinearTerms& terms, double step_size);

 private:
  struct Increments {
    std::array<Field*, 2> field;  // of the last two stages
    Field* laplacian;             // of either; null if nothing diffuses
  };
  template <class Real>
  [[nodiscard]] exec::LinearCoefficients<Real> coefficients(const LinearTerms& terms, double times) const;
  template <class Real>
  void add_linear(const LinearTerms& terms, const Increments& increments);
  template <class Real>
  void run(const LinearTerms& terms, const Increments& increments, double step_size, int stages);

  State& state_;
  DerivedFields& derived_;
  const std::vector<LinearTerms>& staged_;
  double eigenvalue_;
  std::map<std::string, Increments, std::less<>> increments_;
};

/// The rate at which the fastest of the linear terms of a field decays, with a margin for disordered particles, 1/s.
/// `eigenvalue`: largest of minus the Laplacian, 1/m2.
MESOGEN_EXPORT double largest_rate(const LinearTerms& terms, double eigenvalue);

/// The stages that a step needs where the fastest of the linear terms decays at `rate`, 1/s: 2, or an odd number. (Of
/// an even number of stages beyond 2, the shortest waves change sign.)
MESOGEN_EXPORT int stages_needed(double rate, double step_size);

}  // namespace mesogen
