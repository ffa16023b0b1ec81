#include "time/kept_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesogen {

namespace {

/// A time that falls short of another by rounding has reached it.
double reached(double time) { return time + 1e-12 * std::abs(time); }

bool same(double one, double other) { return one <= reached(other) && other <= reached(one); }

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

bool KeptTimes::has(double time) const {
  return every_.has(time) || std::ranges::any_of(times_, [&](double one) { return same(one, time); });
}

double KeptTimes::count(double end) const {
  std::vector<double> times;
  for (const double time : times_)
    if (time > 0.0 && time <= reached(end)) times.push_back(time);
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  // Those that are multiples too count once.
  std::erase_if(times, [&](double time) { return every_.has(time); });
  return every_.count(end) + static_cast<double>(times.size());
}

}  // namespace mesogen
