#include "diagnostics/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <utility>

namespace mesogen {

namespace {

constexpr double terminal_pause = 0.1;  // s of wall time between two lines at the least
constexpr double plain_pause = 2.0;
constexpr double plain_share = 0.1;      // of the run between two plain lines
constexpr double measure_pause = 0.5;    // s of wall time over which the speed is measured at the least
constexpr double smoothing_time = 10.0;  // s of wall time over which speeds are averaged

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Progress(std::ostream& out, Style style) : Progress(out, style, steady_seconds) {}

Progress::Progress(std::ostream& out, Style style, Clock clock) : out_(out), style_(style), clock_(std::move(clock)) {}

Progress::Style Progress::style_for(int descriptor, bool quiet) {
  if (quiet) return Style::silent;
  return isatty(descriptor) != 0 ? Style::terminal : Style::plain;
}

void Progress::start(double time, std::int64_t step, double end, const std::string& time_unit) {
  time_unit_ = time_unit;
  start_ = time;
  end_ = end;
  begun_ = measured_ = written_ = clock_();
  written_time_ = measured_time_ = time;
  first_step_ = measured_step_ = step;
  steps_per_second_ = speed_ = 0.0;
}

void Progress::update(double time, std::int64_t step) {
  if (style_ == Style::silent) return;
  const double now = clock_();
  if (now - measured_ >= measure_pause) measure(now, time, step);
  const bool due = style_ == Style::terminal
                       ? now - written_ >= terminal_pause
                       : now - written_ >= plain_pause && time - written_time_ >= plain_share * (end_ - start_);
  if (!due) return;
  written_ = now;
  written_time_ = time;
  write(line(time));
}

void Progress::finish(double time, std::int64_t step) {
  if (style_ == Style::silent) return;
  const double elapsed = clock_() - begun_;
  const auto steps = step - first_step_;
  const double rate = elapsed > 0.0 ? static_cast<double>(steps) / elapsed : 0.0;
  write(fmt::format("{:3.0f} %  t = {:.6g} of {:.6g} {}  {} steps in {}  {:.4g} steps/s", percent(time), time, end_,
                    time_unit_, steps, duration_text(elapsed), rate));
  if (style_ == Style::terminal) out_ << '\n' << std::flush;
}

void Progress::measure(double now, double time, std::int64_t step) {
  const double wall = now - measured_;
  const double steps_per_second = static_cast<double>(step - measured_step_) / wall;
  const double speed = (time - measured_time_) / wall;
  const double weight = speed_ > 0.0 ? 1.0 - std::exp(-wall / smoothing_time) : 1.0;
  steps_per_second_ += weight * (steps_per_second - steps_per_second_);
  speed_ += weight * (speed - speed_);
  measured_ = now;
  measured_time_ = time;
  measured_step_ = step;
}

double Progress::percent(double time) const { return end_ > 0.0 ? std::clamp(100.0 * time / end_, 0.0, 100.0) : 100.0; }

std::string Progress::line(double time) const {
  std::string text =
      fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} {}", std::floor(percent(time)), time, end_, time_unit_);
  if (speed_ > 0.0)
    text += fmt::format("  {:.4g} steps/s  {} left", steps_per_second_, duration_text((end_ - time) / speed_));
  return text;
}

void Progress::write(const std::string& text) {
  if (style_ == Style::terminal) {
    out_ << "\r\033[K" << text << std::flush;
  } else {
    out_ << text << '\n' << std::flush;
  }
}

std::string duration_text(double seconds) {
  constexpr double longest = 1e9;
  if (!(seconds < longest)) return "very long";
  const auto whole = static_cast<std::int64_t>(std::lround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace mesogen
