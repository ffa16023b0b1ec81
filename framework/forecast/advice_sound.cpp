#include <cmath>

#include "forecast/advice_rules.hpp"

namespace mesogen::rules {

namespace {

/// The plugins' own choice in place of the case's.
std::optional<Advice> automatic_sound(const Setup& setup, const char* name, std::string finding, std::string gain) {
  const std::string key = key_of(setup, "sound_speed");
  if (key.empty()) return std::nullopt;
  return Advice{name, std::move(finding), {key + "=auto"}, std::move(gain)};
}

}  // namespace

// Density varies as the square of speed over sound speed.
std::optional<Advice> sound_too_slow(const AdviceInput& input) {
  const double sound = published(input.setup, "sound_speed");
  const double automatic = published(input.setup, "automatic_sound_speed");
  if (!(sound > 0.0) || !(sound < 0.7 * automatic)) return std::nullopt;
  const double square = std::pow(automatic / sound, 2);
  const bool free = input.steps.limit.find("sound") == std::string::npos && !input.steps.fixed;
  return automatic_sound(
      input.setup, "sound_too_slow",
      fmt::format("the sound, {0:.3g} {3}, is slower than this flow and its stresses ask for, {1:.3g} {3}{2}", sound,
                  automatic, free ? "; faster sound costs nothing up to there" : "",
                  input.setup.source.units.text("m/s")),
      fmt::format("density varies some {:.2g} times less", square));
}

std::optional<Advice> sound_too_fast(const AdviceInput& input) {
  const double sound = published(input.setup, "sound_speed");
  const double automatic = published(input.setup, "automatic_sound_speed");
  if (!(automatic > 0.0) || !(sound > 1.4 * automatic) || input.steps.fixed ||
      input.steps.limit.find("sound") == std::string::npos)
    return std::nullopt;
  return automatic_sound(input.setup, "sound_too_fast",
                         fmt::format("the sound, {0:.3g} {2}, binds the step and is faster than this flow and its "
                                     "stresses ask for, {1:.3g} {2}",
                                     sound, automatic, input.setup.source.units.text("m/s")),
                         fmt::format("{:.2g} times fewer steps", sound / automatic));
}

}  // namespace mesogen::rules
