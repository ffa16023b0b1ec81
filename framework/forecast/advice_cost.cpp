#include <algorithm>
#include <cmath>

#include "forecast/advice_rules.hpp"
#include "forecast/memory.hpp"

namespace mesogen::rules {

namespace {

// Beyond so many smoothing lengths in the box a second derivative of its longest wave begins to drown in the rounding
// of single precision: 6e-8 (L / (2 pi h))^2 = 4e-4.
constexpr double smoothing_lengths_in_single = 500.0;

/// The next number of three digits: so that the last frame is that of the end.
double rounded_up(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return std::ceil(value / digit * (1.0 - 1e-12)) * digit;
}

}  // namespace

// Positions and all that is advanced are kept in double in any case.
std::optional<Suggestion> double_precision(const AdviceInput& input) {
  const Scene& scene = input.setup.scene;
  const double longest = *std::max_element(scene.box.begin(), scene.box.begin() + scene.dimension);
  if (scene.precision == Precision::single_precision || longest > smoothing_lengths_in_single * scene.smoothing_length)
    return std::nullopt;
  return Suggestion{"double_precision",
                    "this scene does not need sums over neighbours in double precision: fields that are advanced in "
                    "time are double in any case",
                    {"run.precision=single"},
                    "the same answer within some 0.1 %, smaller frames, and faster steps"};
}

std::optional<Suggestion> short_step(const AdviceInput& input) {
  const auto& time = input.setup.source.time;
  double limit = HUGE_VAL;
  for (const auto& one : input.setup.limits.all()) limit = std::min(limit, one.seconds);
  if (!std::isfinite(limit)) return std::nullopt;
  const double ratio = time.step ? limit / *time.step : 1.0 / time.factor;
  if (ratio < 1.4) return std::nullopt;
  return Suggestion{"short_step",
                    fmt::format("the step is {:.2g} of the stability limit", 1.0 / ratio),
                    {time.step ? "time.step=auto" : "time.factor=1"},
                    fmt::format("up to {:.2g} times fewer steps; the answer is as good", ratio)};
}

std::optional<Suggestion> large_output(const AdviceInput& input) {
  const auto& source = input.setup.source;
  const double frames = frames_stored(input.setup);
  const double one = frame_bytes(input.setup);
  if (!(input.free_disk > 0.0) || frames < 3.0 || frames * one < input.free_disk / 2.0) return std::nullopt;
  const double fewer = std::max(2.0, std::floor(input.free_disk / 4.0 / one));
  return Suggestion{
      "large_output",
      fmt::format("{:.10g} frames of {:.3g} MB take {:.3g} GB, more than half of the free space on this disk", frames,
                  one / 1e6, frames * one / 1e9),
      {setting("output.interval", rounded_up(source.time.end / (fewer - 1.0)))},
      fmt::format("{:.10g} frames, {:.2g} times fewer bytes", fewer, frames / fewer)};
}

}  // namespace mesogen::rules
