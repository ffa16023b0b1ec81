#include "simulation/run.hpp"

#include <omp.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "diagnostics/resources.hpp"
#include "output/run_folder.hpp"
#include "simulation/observation.hpp"
#include "simulation/results_options.hpp"
#include "simulation/rounded_text.hpp"
#include "simulation/run_trace.hpp"
#include "simulation/stepper.hpp"

namespace mesogen {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point from) { return std::chrono::duration<double>(Clock::now() - from).count(); }

/// A run in progress: steps, observations, frames and checkpoints until the end or the signal to stop.
class Run {
 public:
  Run(Setup& setup, const RunOptions& options, Log& log, Progress& progress)
      : setup_(setup),
        options_(options),
        log_(log),
        progress_(progress),
        trace_(options.trace),
        stepper_(setup),
        observation_(stepper_) {
    log_.open_file(options.folder / "run.log");
    stepper_.world().trace = trace_.trace();
    stepper_.world().times_each = options.profile || trace_.trace() != nullptr;
  }
  ~Run() { trace_.write(log_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  ExitCode begin() { return begin(ResultsWriter::create(results_options(setup_, options_.folder))); }

  /// After a kill before the first checkpoint: whatever results there are make room.
  ExitCode begin_again() { return begin(ResultsWriter::resume(results_options(setup_, options_.folder), -1)); }

  ExitCode resume(const Checkpoint& checkpoint) {
    stepper_.restore(checkpoint);
    observation_.restore(checkpoint);
    ResultsWriter results = ResultsWriter::resume(results_options(setup_, options_.folder), checkpoint.step);
    observation_.declare(results);
    return go_on(results);
  }

 private:
  ExitCode begin(ResultsWriter results) {
    observation_.declare(results);
    stepper_.start();
    observation_.start();
    observation_.observe(std::vector<bool>(setup_.observers.size() + 1, true), results);
    log_.info(fmt::format("{} particles, {} threads, {}, first step {} s (limit: {})", setup_.scene.particle_count,
                          omp_get_max_threads(), precision(), rounded_text(stepper_.next_step(end()).seconds),
                          stepper_.next_step(end()).limit));
    if (const std::string fitted = fitted_spacing_text(setup_.source); !fitted.empty())
      log_.info("particles.spacing is " + rounded_text(setup_.scene.spacing) + " m: " + fitted);
    return go_on(results);
  }

  [[nodiscard]] double end() const { return setup_.source.time.end; }
  [[nodiscard]] std::string precision() const {
    return setup_.scene.precision == Precision::single_precision ? "single precision" : "double precision";
  }
  void tell_device() {
    if (!setup_.why_on_host.empty()) log_.info("computing on the host: " + setup_.why_on_host);
    if (setup_.backend->on_host()) return;
    log_.info("computing on " + setup_.backend->device());
    for (const auto& member : setup_.physics)
      if (!member.on_device)
        log_.warn(member.instance + " computes on the host, since '" + member.type +
                  "' has no code for CUDA: fields go there and back at every step");
  }
  [[nodiscard]] bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  void write_checkpoint(ResultsWriter& results) {
    const Span span(checkpoints_, trace_.trace());
    results.flush();
    Checkpoint checkpoint;
    checkpoint.case_text = setup_.resolved_text;
    checkpoint.version = MESOGEN_VERSION;
    checkpoint.instruction_sets = setup_.instruction_sets;
    stepper_.save(checkpoint);
    observation_.save(checkpoint);
    mesogen::write_checkpoint(options_.folder, checkpoint);
    saved_step_ = checkpoint.step;
  }

  ExitCode go_on(ResultsWriter& results) {
    const World& world = stepper_.world();
    tell_device();
    write_checkpoint(results);
    const auto begun = Clock::now();
    const double cpu_before = cpu_seconds();
    auto saved = begun;
    const std::int64_t first = world.step;
    shares_before_ = shares();
    progress_.start(world.time, world.step, end());
    try {
      while (world.time < end() && !stopped()) {
        const auto [step_size, limit] = stepper_.next_step(end());
        const double from = world.time;
        const bool last = step_size >= end() - from;
        const double to = last ? end() : from + step_size;
        const auto due = observation_.due(from, to, world.step + 1, last);
        stepper_.advance(step_size, due, to);
        observation_.observe(due, results);
        progress_.update(world.time, world.step);
        if (seconds_since(saved) >= setup_.source.output.checkpoint_interval) {
          write_checkpoint(results);
          saved = Clock::now();
        }
      }
    } catch (const std::exception& failure) {
      progress_.finish(world.time, world.step);
      keep_samples(results, failure.what());
      throw;
    }
    const double stepping = seconds_since(begun);
    const double cpu = cpu_seconds() - cpu_before;
    progress_.finish(world.time, world.step);
    // Not twice the same: the two that are kept are to be two.
    if (saved_step_ != world.step) write_checkpoint(results);
    if (world.time < end()) {
      log_.warn(fmt::format("interrupted at t = {} s; `mesogen resume {}` continues", rounded_text(world.time),
                            options_.folder.string()));
      return ExitCode::interrupted;
    }
    results.finish(RunCost{.first_step = first,
                           .steps = world.step - first,
                           .wall_seconds = stepping,
                           .cpu_seconds = cpu,
                           .threads = omp_get_max_threads(),
                           .peak_memory = peak_memory()});
    report(world.step - first, stepping);
    return ExitCode::done;
  }

  // After a failure: its message matters more than that of a disk that is full as well.
  void keep_samples(ResultsWriter& results, const std::string& failure) {
    try {
      results.flush();
    } catch (const Error& error) {
      if (error.what() != failure) log_.warn(error.what());
    }
  }

  void report(std::int64_t steps, double seconds) {
    if (steps == 0) return;
    log_.info(fmt::format("{} steps in {:.1f} s: {:.3f} ms a step, {:.3g} particle-steps/s; neighbours sorted {} times",
                          steps, seconds, 1e3 * seconds / static_cast<double>(steps),
                          static_cast<double>(steps) * setup_.scene.particle_count / seconds,
                          stepper_.world().neighbourhood.sortings()));
    if (!options_.profile) return;
    // What was done before the first step belongs to no step.
    auto all = shares();
    for (std::size_t n = 0; n < all.size(); ++n) {
      all[n].runs -= shares_before_[n].runs;
      all[n].seconds -= shares_before_[n].seconds;
    }
    std::ranges::stable_sort(all, std::ranges::greater(), &Counter::seconds);
    for (const Counter& share : all) {
      if (share.runs == 0) continue;
      log_.info(fmt::format("{:6.2f} %  {:9.3f} ms a step  {:8} runs  {}", 100.0 * share.seconds / seconds,
                            1e3 * share.seconds / static_cast<double>(steps), share.runs, share.title));
    }
  }

  [[nodiscard]] std::vector<Counter> shares() const {
    auto all = stepper_.shares();
    for (const Counter& counter : observation_.counters()) all.push_back(counter);
    all.push_back(checkpoints_);
    return all;
  }

  Setup& setup_;
  const RunOptions& options_;
  Log& log_;
  Progress& progress_;
  RunTrace trace_;
  Stepper stepper_;
  Observation observation_;
  Counter checkpoints_{"output: checkpoint", "output"};
  std::vector<Counter> shares_before_;
  std::int64_t saved_step_ = -1;  ///< of the last checkpoint written
};

}  // namespace

ExitCode run_case(Case source, const PluginRegistry& registry, const RunOptions& options, Log& log,
                  Progress& progress) {
  Problems problems;
  const auto setup = set_up(std::move(source), registry, problems);
  if (options.inspect) options.inspect(*setup);
  RunTrace::check(options.trace, options.folder);
  const RunLock lock = start_run_folder(options.folder, setup->resolved_text, options.overwrite);
  return Run(*setup, options, log, progress).begin();
}

ExitCode resume_run(const PluginRegistry& registry, const RunOptions& options, Log& log, Progress& progress) {
  const std::string text = stored_case(options.folder);
  RunTrace::check(options.trace, options.folder);
  const RunLock lock(options.folder);
  Problems problems;
  Case source = read_case_text(text, (options.folder / "case.toml").string(), {}, problems);
  const auto setup = set_up(std::move(source), registry, problems);
  if (options.inspect) options.inspect(*setup);
  if (!has_checkpoint(options.folder)) {
    log.info("no checkpoint was written yet: starting again from the beginning");
    return Run(*setup, options, log, progress).begin_again();
  }
  std::string which;
  std::vector<std::string> refused;
  const Checkpoint checkpoint =
      read_newest_checkpoint(options.folder, &which, &refused, [&](const Checkpoint& read) -> std::string {
        if (read.version != MESOGEN_VERSION)
          return "it was written by version " + read.version + ", this is " MESOGEN_VERSION;
        if (read.case_text != setup->resolved_text) return "it belongs to another case than case.toml";
        return {};
      });
  for (const std::string& reason : refused) log.warn(reason);
  if (checkpoint.time >= setup->source.time.end) {
    log.info("this run is complete: there is nothing left to compute");
  } else {
    log.info(
        fmt::format("resuming from {} at t = {} s, step {}", which, rounded_text(checkpoint.time), checkpoint.step));
    if (checkpoint.instruction_sets != setup->instruction_sets)
      log.warn(
          fmt::format("the run goes on, but not to the same bits: {} was written by code for other instruction sets "
                      "({}) than this processor or MESOGEN_SIMD chooses ({})",
                      which, checkpoint.instruction_sets, setup->instruction_sets));
  }
  return Run(*setup, options, log, progress).resume(checkpoint);
}

}  // namespace mesogen
