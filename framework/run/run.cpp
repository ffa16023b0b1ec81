#include "run/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "output/kept_checkpoints.hpp"
#include "output/run_folder.hpp"
#include "plugin/crash.hpp"
#include "run/cost_meter.hpp"
#include "run/marks_of.hpp"
#include "run/observation.hpp"
#include "run/rank_log.hpp"
#include "run/results_options.hpp"
#include "run/run_log.hpp"
#include "run/run_session.hpp"
#include "run/run_trace.hpp"
#include "run/stepper.hpp"
#include "text/rounded_text.hpp"

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
        ranks_(*options.ranks),
        trace_(ranks_.is_first() ? options.trace : std::filesystem::path()),
        stepper_(setup),
        observation_(stepper_),
        rank_log_(stepper_.state()),
        crash_(stepper_.state().step, stepper_.state().time, setup.source.units.time),
        marks_(marks_of(setup)) {
    crash_.advise(fmt::format("no checkpoint was written yet: `mesogen resume {}` starts again from the beginning",
                              options_.folder.string()));
    if (ranks_.is_first()) log_.open_file(options.folder / "run.log");
    stepper_.state().clock.trace = trace_.trace();
    stepper_.state().clock.waits = options.profile || trace_.trace() != nullptr;
  }
  ~Run() { trace_.write(log_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// `again`: after a kill before the first checkpoint.
  ExitCode begin(bool again) {
    start();
    if (again) make_way(-1);
    ResultsWriter results = resumed(-1);
    observation_.declare(results);
    observation_.observe(everybody(), results);
    log_.info(fmt::format("results go to {}", options_.folder.string()));
    log_beginning(log_, setup_, stepper_.next_step(marks_, end()));
    return go_on(results);
  }

  ExitCode resume(const Checkpoint& checkpoint) {
    advise_to_resume(checkpoint);
    before_ = checkpoint.cost;
    shortened_for_ = checkpoint.shortened_for;
    origin_ = checkpoint.origin;
    if (checkpoint.starts_branch) return begin_branch(checkpoint);
    // Observers start where the run did; what they kept since then replaces that.
    start();
    stepper_.restore(checkpoint);
    saved_step_ = checkpoint.step;
    observation_.restore(checkpoint);
    make_way(checkpoint.step);
    const EndRecords forgotten = checkpoint.time < end() ? checkpoint.end_records : EndRecords{};
    ResultsWriter results = resumed(checkpoint.step, forgotten);
    observation_.declare(results);
    return go_on(results);
  }

 private:
  void start() {
    if (!same_on_all(ranks_, setup_.resolved_text + setup_.instruction_sets + MESOGEN_VERSION))
      throw Error(ExitCode::bad_case,
                  "ranks start from different cases, or from code for different processors: let all of them read one "
                  "folder, on processors of one kind");
    stepper_.start();
    observation_.start();
  }

  /// The state to go on from is there: the folder takes the case of this session, and what was kept later than that
  /// state goes. (Results that are later go with ResultsWriter::resume.)
  void make_way(std::int64_t step) {
    (void)any(ranks_, false);  // all have read what there was
    if (!ranks_.is_first()) return;
    if (stored_case(options_.folder) != setup_.resolved_text)
      replace_stored_case(options_.folder, setup_.resolved_text);
    remove_kept_checkpoints(options_.folder, step);
  }

  ExitCode begin_branch(const Checkpoint& checkpoint) {
    stepper_.restore(checkpoint);
    make_way(checkpoint.step);
    ResultsWriter results = resumed(-1);
    observation_.declare(results);
    // What passes make for readers is made as at the start of a run, which advances some of what a step goes on from.
    start();
    observation_.observe(everybody(), results);
    stepper_.restore(checkpoint);
    return go_on(results);
  }

  [[nodiscard]] double end() const { return setup_.source.time.end; }
  [[nodiscard]] std::vector<bool> everybody() const { return std::vector<bool>(setup_.observers.size() + 1, true); }
  [[nodiscard]] ResultsWriter resumed(std::int64_t last_step, const EndRecords& forgotten = {}) const {
    if (!ranks_.is_first()) return ResultsWriter::silent();
    ResultsOptions options = results_options(setup_, options_.folder);
    options.origin = origin_;
    return ResultsWriter::resume(std::move(options), last_step, forgotten);
  }
  [[nodiscard]] bool stopped() const { return any(ranks_, options_.stop != nullptr && options_.stop->load()); }
  [[nodiscard]] bool checkpoint_is_due(Clock::time_point saved) const {
    return any(ranks_, ranks_.is_first() && seconds_since(saved) >= setup_.source.output.checkpoint_interval);
  }

  [[nodiscard]] Checkpoint checkpoint() {
    Checkpoint checkpoint;
    checkpoint.case_text = setup_.resolved_text;
    checkpoint.version = MESOGEN_VERSION;
    checkpoint.instruction_sets = setup_.instruction_sets;
    stepper_.save(checkpoint);
    observation_.save(checkpoint);
    checkpoint.cost = cost_.at(checkpoint.step);
    checkpoint.shortened_for = shortened_for_;
    checkpoint.origin = origin_;
    return checkpoint;
  }

  void write(const Checkpoint& checkpoint, ResultsWriter& results) {
    results.flush();
    if (ranks_.is_first()) mesogen::write_checkpoint(options_.folder, checkpoint);
    saved_step_ = checkpoint.step;
    advise_to_resume(checkpoint);
  }

  void advise_to_resume(const Checkpoint& checkpoint) {
    crash_.advise(
        fmt::format("the checkpoint of step {}, t = {} is kept: once the plugin is mended, `mesogen resume "
                    "{}` goes on from there",
                    checkpoint.step, setup_.source.units.time_text(checkpoint.time), options_.folder.string()));
  }

  void write_checkpoint(ResultsWriter& results) {
    const Span span(checkpoints_, trace_.trace());
    results.flush();  // the frame makes room
    write(checkpoint(), results);
  }

  void keep_checkpoint(ResultsWriter& results) {
    const Span span(checkpoints_, trace_.trace());
    results.flush();
    if (const Checkpoint kept = checkpoint(); ranks_.is_first()) mesogen::keep_checkpoint(options_.folder, kept);
  }

  /// Before the first step that is another one only because the run ends where it does.
  void keep_before_end(const Stepper::Step& step, ResultsWriter& results) {
    if (shortened_for_ == end()) return;
    const Stepper::Step longer = stepper_.next_step(marks_, std::numeric_limits<double>::infinity());
    if (step.seconds == longer.seconds && step.arrival == longer.arrival) return;
    const Span span(checkpoints_, trace_.trace());
    results.flush();
    if (const Checkpoint last = checkpoint(); ranks_.is_first()) write_checkpoint_before_end(options_.folder, last);
    shortened_for_ = end();
  }

  /// All look at the last state. What a longer run does not record there is written down as such, and observers are
  /// saved as they were before.
  void record_end(ResultsWriter& results) {
    if (saved_step_ == stepper_.state().step) return;  // resumed from there
    const Span span(checkpoints_, trace_.trace());
    Checkpoint last = checkpoint();
    last.end_records = observation_.record_end(results);
    write(last, results);
  }

  ExitCode go_on(ResultsWriter& results) {
    const State& state = stepper_.state();
    log_device(log_, setup_);
    cost_.start(state.step, before_);
    if (saved_step_ != state.step) write_checkpoint(results);
    auto saved = Clock::now();
    const std::int64_t first = state.step;
    shares_before_ = shares();
    rank_log_.begin();
    progress_.start(state.time, state.step, end(), setup_.source.units.time);
    try {
      while (state.time < end() && !stopped()) {
        const Stepper::Step step = stepper_.next_step(marks_, end());
        keep_before_end(step, results);
        const Arrival from = stepper_.arrival();
        const bool last = step.arrival >= end();
        const auto due = marks_.due(from, {step.arrival, step.seconds}, state.step + 1);
        stepper_.advance(step, last ? everybody() : due);
        log_changes(log_, setup_, stepper_);
        observation_.observe(due, results);
        results.check();
        progress_.update(state.time, state.step);
        if (marks_.keeps(from, stepper_.arrival())) keep_checkpoint(results);
        if (!last && checkpoint_is_due(saved)) {
          write_checkpoint(results);
          saved = Clock::now();
        }
      }
      results.wait();
    } catch (const std::exception& failure) {
      progress_.finish(state.time, state.step);
      keep_samples(results, failure.what());
      throw;
    }
    const double stepping = cost_.seconds();
    const RunCost cost = cost_.at(state.step);
    progress_.finish(state.time, state.step);
    if (state.time < end()) {
      // Not twice the same: the two that are kept are to be two.
      if (saved_step_ != state.step) write_checkpoint(results);
      log_.warn(fmt::format("interrupted at t = {} {}; `mesogen resume {}` continues", rounded_text(state.time),
                            setup_.source.units.time, options_.folder.string()));
      return ExitCode::interrupted;
    }
    record_end(results);
    results.finish(cost);
    report(state.step - first, stepping);
    return ExitCode::done;
  }

  // After a failure: its message matters more than that of a disk that is full as well.
  void keep_samples(ResultsWriter& results, const std::string& failure, bool again = true) {
    try {
      results.flush();
    } catch (const std::exception& error) {
      if (error.what() != failure) log_.warn(error.what());
      if (again) keep_samples(results, error.what(), false);  // if the last frame was lost: without it
    }
  }

  void report(std::int64_t steps, double seconds) {
    if (steps == 0) return;
    log_speed(log_, setup_, steps, seconds, stepper_.state().neighbourhood.sortings());
    if (!options_.profile) return;
    rank_log_.tell(log_, steps, seconds);
    log_shares(log_, shares(), shares_before_, steps, seconds);
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
  const Ranks& ranks_;
  RunTrace trace_;
  Stepper stepper_;
  Observation observation_;
  RankLog rank_log_;
  CrashAdvice crash_;
  Counter checkpoints_{"output: checkpoint", "output"};
  Marks marks_;
  CostMeter cost_;
  RunCost before_;                       ///< of earlier sessions
  std::optional<double> shortened_for_;  ///< see Checkpoint
  std::optional<BranchOrigin> origin_;
  std::vector<Counter> shares_before_;
  std::int64_t saved_step_ = -1;  ///< of the last checkpoint written
};

}  // namespace

ExitCode start_session(Setup& setup, const RunOptions& options, Log& log, Progress& progress) {
  return Run(setup, options, log, progress).begin(false);
}

ExitCode start_session_again(Setup& setup, const RunOptions& options, Log& log, Progress& progress) {
  return Run(setup, options, log, progress).begin(true);
}

ExitCode continue_session(Setup& setup, const Checkpoint& checkpoint, const RunOptions& options, Log& log,
                          Progress& progress) {
  return Run(setup, options, log, progress).resume(checkpoint);
}

}  // namespace mesogen
