#include "output/run_record_file.hpp"

#include <sstream>

namespace mesogen::output {

namespace {

constexpr const char* cost_group = "cost";
constexpr const char* origin_group = "branched_from";
constexpr const char* end_group = "recorded_at_end";

/// One a line, in one attribute.
template <class Texts>
void write_lines(const hdf5::Id& group, const std::string& name, const Texts& texts) {
  std::string lines;
  for (const std::string& text : texts) lines += (lines.empty() ? "" : "\n") + text;
  hdf5::write_attribute(group, name, lines);
}

std::vector<std::string> read_lines(const hdf5::Id& group, const std::string& name) {
  std::istringstream lines(hdf5::read_text_attribute(group, name));
  std::vector<std::string> texts;
  for (std::string line; std::getline(lines, line);) texts.push_back(line);
  return texts;
}

}  // namespace

void write_cost(const hdf5::Id& parent, const RunCost& cost) {
  const hdf5::Id group = hdf5::create_group(parent, cost_group);
  hdf5::write_attribute(group, "steps", cost.steps);
  hdf5::write_attribute(group, "sessions", cost.sessions);
  hdf5::write_attribute(group, "wall_seconds", cost.wall_seconds);
  hdf5::write_attribute(group, "cpu_seconds", cost.cpu_seconds);
  hdf5::write_attribute(group, "threads", static_cast<std::int64_t>(cost.threads));
  hdf5::write_attribute(group, "peak_memory", cost.peak_memory);
}

RunCost read_cost(const hdf5::Id& parent) {
  const hdf5::Id group = hdf5::open_group(parent, cost_group);
  return {.steps = hdf5::read_attribute<std::int64_t>(group, "steps"),
          .sessions = hdf5::read_attribute<std::int64_t>(group, "sessions"),
          .wall_seconds = hdf5::read_attribute<double>(group, "wall_seconds"),
          .cpu_seconds = hdf5::read_attribute<double>(group, "cpu_seconds"),
          .threads = static_cast<int>(hdf5::read_attribute<std::int64_t>(group, "threads")),
          .peak_memory = hdf5::read_attribute<std::int64_t>(group, "peak_memory")};
}

void write_origin(const hdf5::Id& parent, const BranchOrigin& origin) {
  const hdf5::Id group = hdf5::create_group(parent, origin_group);
  hdf5::write_attribute(group, "folder", origin.folder);
  hdf5::write_attribute(group, "checkpoint", origin.checkpoint);
  hdf5::write_attribute(group, "time", origin.time);
  hdf5::write_attribute(group, "step", origin.step);
  write_lines(group, "changes", origin.changes);
}

BranchOrigin read_origin(const hdf5::Id& parent) {
  const hdf5::Id group = hdf5::open_group(parent, origin_group);
  return {.folder = hdf5::read_text_attribute(group, "folder"),
          .checkpoint = hdf5::read_text_attribute(group, "checkpoint"),
          .time = hdf5::read_attribute<double>(group, "time"),
          .step = hdf5::read_attribute<std::int64_t>(group, "step"),
          .changes = read_lines(group, "changes")};
}

bool has_origin(const hdf5::Id& parent) { return hdf5::has(parent, origin_group); }

void write_end_records(const hdf5::Id& parent, const EndRecords& records) {
  const hdf5::Id group = hdf5::create_group(parent, end_group);
  write_lines(group, "observers", records.observers);
  hdf5::write_attribute(group, "frame", static_cast<std::int64_t>(records.frame));
}

EndRecords read_end_records(const hdf5::Id& parent) {
  const hdf5::Id group = hdf5::open_group(parent, end_group);
  const auto observers = read_lines(group, "observers");
  return {.observers = {observers.begin(), observers.end()},
          .frame = hdf5::read_attribute<std::int64_t>(group, "frame") != 0};
}

}  // namespace mesogen::output
