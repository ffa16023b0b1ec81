#include <fmt/format.h>

#include "output/results.hpp"
#include "output/run_folder.hpp"
#include "run/resume_rules.hpp"
#include "run/run_session.hpp"
#include "run/run_trace.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

/// Why a checkpoint is none of this run; empty if it is one.
std::string unfit(const Checkpoint& checkpoint, const std::string& case_text) {
  if (checkpoint.version != MESOGEN_VERSION)
    return "it was written by version " + checkpoint.version + ", this is " MESOGEN_VERSION;
  if (without_resumable_keys(checkpoint.case_text) != without_resumable_keys(case_text))
    return "it belongs to another case than case.toml";
  return {};
}

/// Did the end that a run had make it come to a state that a run to `end` does not pass through?
bool off_course(const Checkpoint& checkpoint, double end) {
  return checkpoint.shortened_for && *checkpoint.shortened_for != end;
}

std::string finished_text(const std::filesystem::path& folder, double time, const Units& units) {
  return fmt::format(
      "this run is finished, at t = {}, and left as it is. `mesogen resume {} --set time.end={}` extends "
      "it; `mesogen branch {} NEW` starts a new run from its checkpoints",
      units.time_text(time), folder.string(), rounded_text(2.0 * time), folder.string());
}

}  // namespace

ExitCode resume_run(const PluginRegistry& registry, const RunOptions& options, const std::vector<std::string>& changes,
                    Log& log, Progress& progress) {
  const std::string text = stored_case(options.folder);
  RunTrace::check(options.trace, options.folder);
  std::optional<RunLock> lock;
  if (options.ranks->is_first()) lock.emplace(options.folder);
  const std::string file = (options.folder / "case.toml").string();
  Problems problems;
  check_resumed_keys(changes, options.folder.string(), problems);
  problems.throw_if_any();
  const auto setup = set_up(read_case_text(text, file, changes, problems), registry, problems);
  setup->ranks = options.ranks;
  if (options.inspect) options.inspect(*setup);
  const double end = setup->source.time.end;
  if (!has_checkpoint(options.folder)) {
    log.info("no checkpoint was written yet: starting again from the beginning");
    return start_session_again(*setup, options, log, progress);
  }
  std::string which;
  std::vector<std::string> refused;
  Checkpoint checkpoint = read_newest_checkpoint(
      options.folder, &which, &refused, [&](const Checkpoint& read) { return unfit(read, setup->resolved_text); });
  for (const std::string& reason : refused) log.warn(reason);
  check_resumed_values(read_case_text(text, file, {}, problems), setup->source, {checkpoint.time, checkpoint.step_size},
                       problems);
  problems.throw_if_any();
  if (depends_on_end(*setup)) {
    const auto before = set_up(read_case_text(text, file, {}, problems), registry, problems);
    check_resumed_values(*before, *setup, options.folder.string(), problems);
    problems.throw_if_any();
  }
  if (off_course(checkpoint, end))
    checkpoint = read_newest_checkpoint(options.folder, &which, nullptr, [&](const Checkpoint& read) -> std::string {
      if (std::string fault = unfit(read, setup->resolved_text); !fault.empty()) return fault;
      return off_course(read, end)
                 ? "its last steps were shortened to end at t = " + setup->source.units.time_text(*read.shortened_for) +
                       ", so it is no state of a longer run; `mesogen branch` can start from it"
                 : std::string();
    });
  if (checkpoint.time < end) {
    log.info(fmt::format("resuming from {} at t = {}, step {}, to t = {}", which,
                         setup->source.units.time_text(checkpoint.time), checkpoint.step,
                         setup->source.units.time_text(end)));
    if (checkpoint.instruction_sets != setup->instruction_sets)
      log.warn(
          fmt::format("the run goes on, but not to the same bits: {} was written by code for other instruction sets "
                      "({}) than this processor or MESOGEN_SIMD chooses ({})",
                      which, checkpoint.instruction_sets, setup->instruction_sets));
  } else if (setup->resolved_text == text && ResultsWriter::are_finished(options.folder)) {
    log.info(finished_text(options.folder, checkpoint.time, setup->source.units));
    return ExitCode::done;
  } else {
    log.info("all steps are done: the results are put together");
  }
  return continue_session(*setup, checkpoint, options, log, progress);
}

}  // namespace mesogen
