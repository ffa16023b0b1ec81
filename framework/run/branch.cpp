#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "output/kept_checkpoints.hpp"
#include "output/run_folder.hpp"
#include "run/branch_rules.hpp"
#include "run/run_session.hpp"
#include "run/run_trace.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

struct Found {
  std::string file;  ///< relative to the run's folder
  Checkpoint checkpoint;
};

bool same_time(double one, double other) { return std::abs(one - other) <= 1e-9 * std::abs(other); }

void check_version(const fs::path& file, const Checkpoint& checkpoint) {
  if (checkpoint.version != MESOGEN_VERSION)
    throw Error(ExitCode::bad_case, "cannot use " + file.string() + ": it was written by version " +
                                        checkpoint.version + ", this is " MESOGEN_VERSION);
}

[[noreturn]] void refuse_time(const fs::path& folder, double at, std::vector<double> times, const Units& units) {
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end(), same_time), times.end());
  std::ranges::stable_sort(times, {}, [&](double time) { return std::abs(time - at); });
  constexpr std::size_t most = 6;
  const bool more = times.size() > most;
  times.resize(std::min(times.size(), most));
  std::vector<std::string> texts;
  texts.reserve(times.size());
  for (const double time : times) texts.push_back(fmt::format("{:.12g}", time));
  throw Error(ExitCode::bad_case,
              times.empty() ? fmt::format("{} holds no checkpoint to branch from", folder.string())
                            : fmt::format("{0} holds no checkpoint at t = {1} {4}. {2} t = {3} {4}. A run with "
                                          "output.checkpoint_times = [{1}] keeps one there",
                                          folder.string(), at, more ? "The nearest are at" : "There are those at",
                                          fmt::join(texts, ", "), units.time));
}

/// That of a time: one of those that are kept for good, or of the last. These are read once, since a run that goes on
/// replaces them.
Found find_checkpoint_at(const fs::path& folder, double at, const Units& units) {
  std::vector<double> times;
  for (const KeptCheckpoint& kept : kept_checkpoints(folder)) {
    if (same_time(kept.time, at)) return {kept.name, read_checkpoint(folder / kept.name)};
    times.push_back(kept.time);
  }
  for (const char* name : newest_checkpoint_names) {
    std::error_code error;
    if (!fs::exists(folder / name, error)) continue;
    try {
      Checkpoint read = read_checkpoint(folder / name);
      if (same_time(read.time, at)) return {name, std::move(read)};
      times.push_back(read.time);
    } catch (const Error&) {
      continue;  // damaged, or of a run that is just being replaced
    }
  }
  refuse_time(folder, at, std::move(times), units);
}

Found find_checkpoint(const BranchPoint& from, const Units& units) {
  Found found;
  if (from.at)
    found = find_checkpoint_at(from.folder, *from.at, units);
  else
    found.checkpoint = read_newest_checkpoint(from.folder, &found.file);
  check_version(from.folder / found.file, found.checkpoint);
  return found;
}

/// The state that a branch begins with: the particles of another run, and nothing of its records.
Checkpoint first_checkpoint(const Setup& before, const Setup& after, const BranchPoint& from,
                            const std::vector<std::string>& changes, Found found) {
  Checkpoint first = std::move(found.checkpoint);
  first.origin =
      BranchOrigin{fs::absolute(from.folder).lexically_normal().string(), found.file, first.time, first.step, changes};
  first.case_text = after.resolved_text;
  first.instruction_sets = after.instruction_sets;
  first.precision = after.scene.precision;
  first.observers.clear();
  first.cost = {};
  first.end_records = {};
  first.shortened_for.reset();
  first.starts_branch = true;
  if (!same_cells(before, after))
    std::erase_if(first.numbers, [](const auto& entry) { return entry.first.starts_with("sorted position "); });
  return first;
}

}  // namespace

ExitCode branch_run(const PluginRegistry& registry, const BranchPoint& from, const std::vector<std::string>& changes,
                    const RunOptions& options, Log& log, Progress& progress) {
  const std::string text = stored_case(from.folder);
  std::error_code ignored;
  if (fs::equivalent(from.folder, options.folder, ignored))
    throw Error(ExitCode::bad_case,
                options.folder.string() + " is the run to branch from: choose another folder for the new run");
  RunTrace::check(options.trace, options.folder);
  const std::string file = (from.folder / "case.toml").string();
  Problems problems;
  const auto before = set_up(read_case_text(text, file, {}, problems), registry, problems);
  Case source = read_case_text(text, file, changes, problems);
  if (problems.empty()) check_branched_case(before->source, source, problems);
  const auto after = set_up(std::move(source), registry, problems);
  Found found = find_checkpoint(from, after->source.units);
  check_branched_setup(*before, *after, found.checkpoint, problems);
  problems.throw_if_any();
  if (options.inspect) options.inspect(*after);
  const std::string name = (from.folder / found.file).string();
  const Checkpoint first = first_checkpoint(*before, *after, from, changes, std::move(found));
  after->ranks = options.ranks;
  if (!options.ranks->is_first()) return continue_session(*after, first, options, log, progress);
  const RunLock lock = start_run_folder(options.folder, after->resolved_text, options.overwrite, &first);
  log.info(fmt::format("branching from {} at t = {}, step {}, to t = {}", name,
                       after->source.units.time_text(first.time), first.step,
                       after->source.units.time_text(after->source.time.end)));
  return continue_session(*after, first, options, log, progress);
}

}  // namespace mesogen
