#include "run/resume_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/toml_reader.hpp"
#include "case/toml_text.hpp"
#include "case/value.hpp"

namespace mesogen {

namespace {

std::string key_of(const std::string& change) {
  std::string key = change.substr(0, change.find('='));
  std::erase_if(key, [](char c) { return c == ' ' || c == '\t'; });
  return key;
}

void erase_key(Value& root, const std::string& path) {
  const std::size_t dot = path.find('.');
  auto* const table = root.as<Value::Table>();
  if (table == nullptr) return;
  if (dot == std::string::npos) {
    std::erase_if(*table, [&](const Entry& entry) { return entry.key == path; });
    return;
  }
  for (Entry& entry : *table)
    if (entry.key == path.substr(0, dot)) erase_key(entry.value, path.substr(dot + 1));
}

std::vector<double> until(const std::vector<double>& times, double time) {
  std::vector<double> past;
  std::ranges::copy_if(times, std::back_inserter(past), [&](double one) { return one <= time; });
  std::ranges::sort(past);
  return past;
}

}  // namespace

const std::vector<std::string>& resumable_keys() {
  static const std::vector<std::string> keys = {"time.end", "output.checkpoint_interval", "output.checkpoint_times",
                                                "run.device", "title"};
  return keys;
}

void check_resumed_keys(const std::vector<std::string>& changes, const std::string& folder, Problems& problems) {
  const auto& keys = resumable_keys();
  for (const std::string& change : changes) {
    const std::string key = key_of(change);
    if (std::ranges::find(keys, key) != keys.end()) continue;
    problems.add(
        {"--set", 0, 0}, key,
        fmt::format("cannot change while a run goes on: its past was computed with the old value; `mesogen "
                    "branch {} NEW --set {}` starts a new run with it from a checkpoint. What can change here: {}",
                    folder, change, fmt::join(keys, ", ")));
  }
}

void check_resumed_values(const Case& before, const Case& after, const Arrival& now, Problems& problems) {
  const SourcePlace place{"--set", 0, 0};
  if (after.time.end <= now.reaches() && after.time.end != before.time.end)
    problems.add(place, "time.end",
                 fmt::format("must be later than t = {}, since the run has come that far, but is {}",
                             after.units.time_text(now.time), after.units.time_text(after.time.end)));
  const auto& times = after.output.checkpoint_times;
  if (until(times, now.reaches()) != until(before.output.checkpoint_times, now.reaches()))
    problems.add(place, "output.checkpoint_times",
                 fmt::format("must stay as it was up to t = {}, where the run is now: [{}], and may name other times "
                             "only after that",
                             after.units.time_text(now.time),
                             fmt::join(until(before.output.checkpoint_times, now.reaches()), ", ")));
}

bool depends_on_end(const Setup& setup) { return std::ranges::any_of(setup.prescribed, &Prescribed::changes_in_time); }

void check_resumed_values(const Setup& before, const Setup& after, const std::string& folder, Problems& problems) {
  for (std::size_t n = 0; n < after.prescribed.size(); ++n) {
    const Prescribed& one = after.prescribed[n];
    if (n < before.prescribed.size() && before.prescribed[n].largest == one.largest) continue;
    problems.add(
        {"--set", 0, 0}, "time.end",
        fmt::format("cannot be {}: {} gets larger on the way there than up to t = {}, by which the run chose its "
                    "steps and its speed of sound; `mesogen branch {} NEW --set time.end={}` goes on with others",
                    after.source.units.time_text(after.source.time.end), full_key(one),
                    after.source.units.time_text(before.source.time.end), folder, after.source.time.end));
  }
}

std::string without_resumable_keys(std::string_view resolved_text) {
  Problems problems;
  const auto tree = parse_toml(resolved_text, "case.toml", problems);
  if (tree == nullptr) return std::string(resolved_text);
  for (const std::string& key : resumable_keys()) erase_key(*tree, key);
  return document_text(*tree);
}

}  // namespace mesogen
