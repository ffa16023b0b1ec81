#include "check_facts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

#include "diagnostics/resources.hpp"
#include "forecast/instability.hpp"

namespace mesogen::app {

namespace {

constexpr double seconds_of_timing = 2.0;

// Beyond this, setting the case up once more to see what following the advice takes would itself take long.
constexpr double most_particles = 2e7;

double free_disk() {
  std::error_code error;
  const auto space = std::filesystem::space(".", error);
  return error ? 0.0 : static_cast<double>(space.available);
}

double disk(const Setup& setup) {
  const double frames = 1.0 + std::ceil(setup.source.time.end / setup.source.output.interval * (1.0 - 1e-9));
  return frames * frame_bytes(setup) + 2.0 * checkpoint_bytes(setup);
}

/// Advice that the case does not take, such as a spacing that does not fit its box, is not given.
std::vector<AdviceFacts> follow(const Setup& setup, const StepForecast& steps, double program,
                                const SetUpWith& set_up_with) {
  std::vector<AdviceFacts> all;
  if (setup.scene.particle_count > most_particles) return all;
  for (Advice& one : advice({setup, steps, free_disk()})) {
    try {
      const auto followed = set_up_with(one.settings);
      all.push_back({std::move(one), followed->scene.particle_count, forecast_steps(*followed).expected,
                     forecast_memory(*followed, program).peak(), disk(*followed)});
    } catch (const Error&) {
    }
  }
  return all;
}

}  // namespace

CheckFacts check_facts(Setup& setup, bool timed, double program, const SetUpWith& set_up_with) {
  CheckFacts facts;
  facts.numbers = dimensionless_numbers(setup.scene, uniform_director(setup.source));
  for (SceneNumber& number : facts.numbers) number.unit = setup.source.units.text(number.unit);
  facts.steps = forecast_steps(setup);
  facts.memory = forecast_memory(setup, program);
  facts.memory_available = static_cast<double>(available_memory());
  facts.frames = 1.0 + std::ceil(setup.source.time.end / setup.source.output.interval * (1.0 - 1e-9));
  facts.frame_bytes = frame_bytes(setup);
  facts.checkpoint_bytes = checkpoint_bytes(setup);
  facts.advice = follow(setup, facts.steps, program, set_up_with);
  if (!timed) {
    facts.not_timed = "--quick";
  } else if (facts.memory_available > 0.0 && facts.memory.peak() > facts.memory_available) {
    facts.not_timed = "there is not enough memory for the run";
  } else {
    try {
      facts.time = forecast_time(setup, facts.steps, cpu_seconds(), seconds_of_timing);
    } catch (const Error& error) {
      if (error.code() != ExitCode::run_failed) throw;
      facts.not_timed = error.what();
      facts.breaks_down = true;
    }
  }
  return facts;
}

}  // namespace mesogen::app
