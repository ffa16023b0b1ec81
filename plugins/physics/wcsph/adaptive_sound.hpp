#pragma once

// The speed of sound while a run goes on. It is chosen from what a scene tells at its start; a flow or a stress that
// grows far beyond that compresses the fluid more than was meant, and the sound is made faster.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <utility>

namespace mesogen::wcsph {

/// Density varies as 1 / c0^2, in proportion to what drives it. Sound comes and goes, so the largest |c| is averaged
/// over the time that sound takes through the box. The sound rises
///   where the average exceeds 3 delta (0.15 at most), so that delta is left of it (turbulence whose stress is known at
///   the start has
///     1.5 to 2.5 delta);
///   where |c| exceeds 10 delta (0.21 at most) at any moment, so that half of that is left;
///   where the flow exceeds half of the sound, to four times the flow: a parallel one compresses nothing, and breaks.
/// What breaks for another reason would drive the sound up for ever. So compression raises it tenfold at most, beyond
/// the start and the flow, and a flow that compresses the fluid by 10 delta or more does not count.
class AdaptiveSound {
 public:
  /// `speed`: at the start, m/s. `density_variation`: delta. `length`: longest edge of the box, m.
  void start(double speed, double density_variation, double length, bool adapts) {
    initial_ = speed;
    delta_ = density_variation;
    length_ = length;
    adapts_ = adapts;
    state_ = {};
    change_.clear();
  }

  /// c0, m/s.
  [[nodiscard]] double speed() const { return adapts_ ? std::max(initial_, state_[risen]) : initial_; }
  /// By how much compression shrinks in the step that is under way, because the sound gets faster with its end:
  /// (c0 / the new c0)^2, or 1. The pressure stays as it is.
  [[nodiscard]] double softening() const {
    const double ratio = adapts_ ? speed() / std::max(speed(), state_[next]) : 1.0;
    return ratio * ratio;
  }

  /// The step has made compression smaller by softening(): from now on the sound is faster.
  void rise() {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "sound_speed rises from %.4g to %.4g", speed(), state_[next]);
    change_ = text.data();
    state_[lasting] *= softening();
    state_[risen] = state_[next];
  }

  /// After a step: the largest speed, m/s; then the largest |c|. Returns what changed, for the log; empty: nothing.
  void flows_at(double fastest) { fastest_ = fastest; }
  std::string after_step(double compression, double step_size) {
    if (!adapts_) return {};
    double& average = state_[lasting];
    average += (compression - average) * step_size / (step_size + length_ / speed());
    double wanted = 0.0;
    const auto needs = [&](double value, double most, double left) {
      if (value > most) wanted = std::max(wanted, speed() * std::sqrt(value / left));
    };
    needs(average, std::min(3.0 * delta_, 0.5 * broken), delta_);
    const double at_once = std::min(10.0 * delta_, 0.7 * broken);
    needs(compression, at_once, at_once / 2.0);
    double& by_flow = state_[flow];
    if (fastest_ > speed() / 2.0 && compression < at_once) by_flow = 4.0 * fastest_;
    state_[next] = std::max(by_flow, std::min(wanted, 10.0 * std::max(initial_, by_flow)));
    return std::exchange(change_, {});
  }

  /// What checkpoints keep.
  static constexpr std::size_t kept = 4;
  [[nodiscard]] std::span<double> state() { return state_; }

  /// |c| at which a run is stopped.
  static constexpr double broken = 0.3;

 private:
  enum State {
    risen,    ///< c0, m/s; 0: as at the start
    next,     ///< what it will be after the next step, m/s; c0 or less: no other
    lasting,  ///< average of the largest |c|
    flow,     ///< c0 that the speed of the flow asked for, m/s
  };

  double initial_ = 0.0;
  double delta_ = 0.0;
  double length_ = 0.0;
  double fastest_ = 0.0;
  std::string change_;
  bool adapts_ = false;
  std::array<double, kept> state_{};
};

}  // namespace mesogen::wcsph
