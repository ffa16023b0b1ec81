#include "check_facts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "diagnostics/resources.hpp"

namespace mesogen::app {

namespace {

constexpr double seconds_of_timing = 2.0;

/// The angle of a director that is uniform but for small disturbances.
std::optional<double> uniform_director(const Case::Director& director) {
  if (!director.given || director.type == "defects") return std::nullopt;
  return director.angle;
}

}  // namespace

CheckFacts check_facts(Setup& setup, bool timed, double program) {
  CheckFacts facts;
  facts.numbers = dimensionless_numbers(setup.scene, uniform_director(setup.source.director));
  facts.steps = forecast_steps(setup);
  facts.memory = forecast_memory(setup, program);
  facts.memory_available = static_cast<double>(available_memory());
  facts.frames = 1.0 + std::ceil(setup.source.time.end / setup.source.output.interval * (1.0 - 1e-9));
  facts.frame_bytes = frame_bytes(setup);
  facts.checkpoint_bytes = checkpoint_bytes(setup);
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
