#include "time/kept_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesogen {

namespace {

/// A time that falls short of another by rounding has reached it.
double reached(double time) { return time + 1e-12 * std::abs(time); }

}  // namespace

KeptTimes::KeptTimes(std::vector<double> times, std::optional<double> every)
    : times_(std::move(times)), every_{every, {}} {
  std::ranges::sort(times_);
}

double KeptTimes::next(double time, double end) const {
  double next = std::numeric_limits<double>::infinity();
  if (const auto at = std::ranges::upper_bound(times_, reached(time)); at != times_.end()) next = *at;
  return std::min(next, every_.next(time, end));
}

bool KeptTimes::due(double from, double to) const { return next(from) <= reached(to); }

}  // namespace mesogen
