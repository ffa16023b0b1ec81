#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case_text.hpp"
#include "run/setup.hpp"
#include "run/stepper.hpp"

namespace mesogen::test {

/// A case run in this process, without a folder: as far as the test wants, with everything in reach.
class CaseRun {
 public:
  /// Throws Error with all problems of the case. Rates are evaluated at the start, as in a run. `settings`: keys
  /// changed, as by --set.
  explicit CaseRun(const CaseText& text, const std::vector<std::string>& settings = {});
  /// Not started: for Stepper::restore.
  static CaseRun unstarted(const CaseText& text);

  /// Goes on until this time, s, exactly.
  void run_to(double time);
  void run_steps(int steps);

  [[nodiscard]] double time() { return stepper_->state().time; }
  /// Component of a field by id. Derived fields are brought up to date if the case reads them (CaseText::read).
  [[nodiscard]] std::vector<double> field(const std::string& name, int component = 0);
  /// Coordinate along an axis by id, without jumps at the faces, m.
  [[nodiscard]] std::vector<double> path(int axis);
  /// One sample of an observer plugin, with its default parameters. What it reads must be kept: CaseText::read.
  [[nodiscard]] Sample sample(const std::string& observer);
  /// A quantity of one number.
  [[nodiscard]] double observe(const std::string& observer, const std::string& quantity);

  [[nodiscard]] Stepper& stepper() { return *stepper_; }
  [[nodiscard]] State& state() { return stepper_->state(); }
  [[nodiscard]] Setup& setup() { return *setup_; }

 private:
  CaseRun(const CaseText& text, const std::vector<std::string>& settings, bool start);

  std::unique_ptr<Setup> setup_;
  std::unique_ptr<Stepper> stepper_;
  std::vector<bool> nobody_;
};

/// Amplitudes of cos(k . x) and sin(k . x) in values at particles of a square box, k = 2 pi (mx, my) / length.
struct Wave {
  double cosine;
  double sine;
};
Wave wave_of(CaseRun& run, const std::vector<double>& values, int mx, int my);

}  // namespace mesogen::test
