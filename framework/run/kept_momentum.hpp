#pragma once

#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"
#include "run/setup.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// Do all forces of this scene conserve momentum? In a box that is periodic along every axis they do if all passes that
/// add to the acceleration say so: Pass::conserves_momentum.
MESOGEN_EXPORT bool conserves_momentum(const Setup& setup);

/// Keeps the mean velocity of the fluid at that of the start, in scenes whose forces conserve momentum. Forces by
/// corrected sums over neighbours add up to a little, which would grow into a uniform flow by chance: to a fifth of
/// v_rms in 100,000 steps of the benchmark. All particles have the same mass, and a uniform flow changes the rest of
/// the flow in nothing, so it may be taken away.
class KeptMomentum {
 public:
  KeptMomentum(const Setup& setup, State& state);

  /// At the start of a run: takes the mean velocity of now.
  void start();
  /// After a step: is it time to keep() it?
  [[nodiscard]] bool due() const;
  void keep();

  void save(Checkpoint& checkpoint) const;
  void restore(const Checkpoint& checkpoint);

 private:
  [[nodiscard]] std::vector<double> mean();
  [[nodiscard]] double exact_sum(int component) const;
  [[nodiscard]] double sum_of_parts(int component);
  template <class Real>
  void add(const std::vector<double>& change);

  State& state_;
  Field* velocity_ = nullptr;  // null if its momentum is not kept
  std::vector<double> kept_;   // mean velocity, m/s
  exec::Array<double> parts_;  // of a sum on a device
};

}  // namespace mesogen
