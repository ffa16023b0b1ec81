#include "check_facts.hpp"

#include "diagnostics/resources.hpp"
#include "forecast/disk.hpp"
#include "room.hpp"

namespace mesogen::app {

namespace {

constexpr double seconds_of_timing = 2.0;

// Beyond this, setting the case up once more to see what following the advice takes would itself take long.
constexpr double most_particles = 2e7;

// Where a run would write, if it is not told otherwise.
double free_here() { return free_disk("output"); }

/// Advice that the case does not take, such as a spacing that does not fit its box, is not given.
std::vector<AdviceFacts> follow(const Setup& setup, const StepForecast& steps, double program,
                                const SetUpWith& set_up_with) {
  std::vector<AdviceFacts> all;
  if (setup.scene.particle_count > most_particles) return all;
  for (Suggestion& one : advice({setup, steps, free_here()})) {
    try {
      const auto followed = set_up_with(one.settings);
      all.push_back({std::move(one), followed->scene.particle_count, forecast_steps(*followed).expected,
                     forecast_memory(*followed, program).peak(), bytes_on_disk(*followed)});
    } catch (const Error&) {
    }
  }
  return all;
}

}  // namespace

CheckFacts check_facts(Setup& setup, bool timed, double program, const SetUpWith& set_up_with) {
  CheckFacts facts;
  facts.numbers = scene_numbers(setup);
  facts.steps = forecast_steps(setup);
  facts.memory = forecast_memory(setup, program);
  facts.memory_available = static_cast<double>(available_memory());
  facts.frames = frames_stored(setup);
  facts.frame_bytes = frame_bytes(setup);
  facts.checkpoints = checkpoints_stored(setup);
  facts.checkpoint_bytes = checkpoint_bytes(setup);
  facts.disk = bytes_on_disk(setup);
  refuse_beyond_memory(setup, facts.memory, facts.memory_available, program, set_up_with, facts.problems);
  if (const auto excess = beyond_disk(setup, free_here()))
    facts.problems.add(setup.source.place(excess->key), excess->key, excess->text);
  if (const std::string text = beyond_steps(setup, facts.steps); !text.empty()) facts.warnings.push_back(text);
  facts.advice = follow(setup, facts.steps, program, set_up_with);
  if (!timed) {
    facts.not_timed = "--quick";
  } else if (!facts.problems.empty()) {
    facts.not_timed = "it cannot be run here";
  } else {
    try {
      facts.time = forecast_time(
          setup, [&] { return set_up_with({}); }, facts.steps, cpu_seconds(), seconds_of_timing);
    } catch (const Error& error) {
      if (error.code() != ExitCode::run_failed) throw;
      facts.not_timed = error.what();
      facts.breaks_down = true;
    }
  }
  return facts;
}

}  // namespace mesogen::app
