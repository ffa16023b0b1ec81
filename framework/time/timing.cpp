#include "time/timing.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace mesogen {

namespace {

// A time that falls short of a mark by rounding has reached it.
double marks_until(double time, double interval) { return std::floor(time / interval * (1.0 + 1e-12) + 1e-9); }

// Is a mark the end but for the digits of the interval?
bool is_end(double mark, double end, double interval) { return end - mark <= 1e-6 * interval; }

}  // namespace

double rounded_time(double time) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), time, std::chars_format::scientific, 13).ptr;
  double rounded = time;
  std::from_chars(text.begin(), end, rounded);
  return rounded;
}

double Timing::next(double time, double end) const {
  if (!interval) return std::numeric_limits<double>::infinity();
  const double mark = rounded_time((marks_until(time, *interval) + 1.0) * *interval);
  return mark < end && is_end(mark, end, *interval) ? end : mark;
}

bool Timing::due(double from, double to, std::int64_t steps) const {
  if (every && steps % *every == 0) return true;
  return interval && marks_until(to, *interval) > marks_until(from, *interval);
}

bool Timing::has(double time) const { return count(time) > count(time - 1e-6 * interval.value_or(0.0)); }

double Timing::count(double time) const { return interval ? marks_until(time, *interval) : 0.0; }

double Timing::count_in_run(double end, double steps) const {
  if (every) return std::ceil(steps / static_cast<double>(*every));
  const double marks = count(end);
  return marks >= 1.0 && is_end(marks * *interval, end, *interval) ? marks : marks + 1.0;
}

}  // namespace mesogen
