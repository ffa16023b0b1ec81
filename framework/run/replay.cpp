#include "run/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "output/run_folder.hpp"
#include "output/samples_file.hpp"
#include "output/stored_frames.hpp"
#include "output/write_file.hpp"
#include "run/observation.hpp"
#include "run/results_options.hpp"
#include "schedule/derived_name.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

/// The state as the frames show it, one after the other, and the observers that look at it.
class Replay {
 public:
  Replay(Setup& setup, const StoredFrames& frames, const std::filesystem::path& folder, Log& log)
      : setup_(setup), frames_(frames), folder_(folder), log_(log) {}

  output::SampleStore run();

 private:
  void choose_fields();
  [[nodiscard]] std::string missing_source(const std::string& field) const;
  [[nodiscard]] bool never_changes(const std::string& field) const;
  void show(std::size_t frame, State& state) const;

  Setup& setup_;
  const StoredFrames& frames_;
  const std::filesystem::path& folder_;
  Log& log_;
};

/// Set by the initial conditions, then by nobody: it need not be stored.
bool Replay::never_changes(const std::string& field) const {
  const Catalogue::Entry* const entry = setup_.catalogue.find(field);
  if (entry == nullptr || !entry->initial || entry->declaration.advance != Advance::never) return false;
  return std::ranges::none_of(setup_.graph->passes(), [&](const ScheduledPass& scheduled) {
    const auto names = [&](const std::vector<std::string>& list) {
      return std::ranges::find(list, field) != list.end();
    };
    return names(scheduled.pass.write_list) || names(scheduled.pass.accumulate_list);
  });
}

/// The field that would have to be stored for this one to be known; empty if it is known.
std::string Replay::missing_source(const std::string& field) const {
  // What a pass makes for readers is made here too, if what that reads is known.
  for (const ScheduledPass& scheduled : setup_.graph->passes()) {
    if (scheduled.pass.phase != Phase::observe ||
        std::ranges::find(scheduled.pass.write_list, field) == scheduled.pass.write_list.end())
      continue;
    for (const auto* const list :
         {&scheduled.pass.own_reads, &scheduled.pass.neighbour_reads, &scheduled.pass.optional_reads})
      for (const std::string& source : *list)
        if (std::string missing = setup_.catalogue.exists(source) ? missing_source(source) : ""; !missing.empty())
          return missing;
    return {};
  }
  const Catalogue::Entry* const entry = setup_.catalogue.find(field);
  if (entry != nullptr && entry->prescribed) {
    // Made anew, also where frames hold it.
    for (const std::string& source : entry->sources)
      if (std::string missing = missing_source(source); !missing.empty()) return missing;
    return {};
  }
  if (frames_.find(field) != nullptr || never_changes(field)) return {};
  if (entry != nullptr) return field;
  const DerivedName derived = derived_name(field);
  return derived.source.empty() ? std::string() : missing_source(derived.source);
}

/// Observers do without what they read only if it is present; what else is missing is an error.
void Replay::choose_fields() {
  std::string problems;
  for (auto& member : setup_.observers) {
    auto required = member.plan.read_list();
    for (const auto& [field, otherwise] : member.plan.otherwise_list()) {
      required.push_back(otherwise);
      if (setup_.catalogue.exists(field) && !missing_source(field).empty()) member.fields.push_back(otherwise);
    }
    std::erase_if(member.fields, [&](const std::string& field) {
      const std::string missing = missing_source(field);
      if (missing.empty()) return false;
      const std::string reads =
          field == missing ? fmt::format("'{}'", field) : fmt::format("'{}', made from '{}'", field, missing);
      if (std::ranges::find(required, field) == required.end()) {
        log_.warn("observers." + member.instance + " does without " + reads + ", which the frames do not hold");
      } else {
        problems += fmt::format(
            "{}observers.{} reads {}, which the frames of {} do not hold: run the case again with '{}' in "
            "output.fields, or leave this observer out",
            problems.empty() ? "" : "\n", member.instance, reads, folder_.string(), missing);
      }
      return true;
    });
    if (member.plan.follows())
      log_.info("observers." + member.instance +
                " follows every step of a run; here it sees the frames alone, and goes straight from one to the next");
  }
  if (!problems.empty()) throw Error(ExitCode::bad_case, problems);
}

void Replay::show(std::size_t frame, State& state) const {
  const auto take = [&](const std::string& name, const auto& put) {
    const output::FieldShape* const shape = frames_.find(name);
    if (shape == nullptr)
      throw Error(ExitCode::bad_case, "the frames of " + folder_.string() + " hold no '" + name +
                                          "': they were written by an older version; run the case again");
    const std::vector<double> values = frames_.read(frame, *shape);
    const auto id = state.particles.id.host();
    for (std::size_t place = 0; place < id.size(); ++place)
      for (int c = 0; c < shape->components; ++c)
        put(c, place, values[static_cast<std::size_t>(id[place] * shape->components + c)]);
  };
  state.order.return_to_integration();
  constexpr auto write = exec::Access::read_write;
  take("position",
       [&](int d, std::size_t place, double value) { state.particles.position[d].host(write)[place] = value; });
  take("image", [&](int d, std::size_t place, double value) {
    state.particles.images[d].host(write)[place] = static_cast<std::int32_t>(value);
  });
  for (const output::FieldShape& shape : frames_.fields()) {
    Field* const field = state.fields.find(shape.name);
    if (field == nullptr || field->components() != shape.components) continue;
    take(shape.name, [&](int c, std::size_t place, double value) { field->set(c, static_cast<Index>(place), value); });
    ++field->version;
  }
  state.order.mark_moved();
  state.step = frames_.stamp(frame).step;
  state.time = frames_.stamp(frame).time;
}

output::SampleStore Replay::run() {
  choose_fields();
  Stepper stepper(setup_);
  Observation observation(stepper);
  output::SampleStore samples;
  for (const auto& member : setup_.observers)
    for (Quantity quantity : member.plan.quantities()) {
      quantity.unit(setup_.source.units.text(quantity.unit_text));
      samples.declare(member.instance, quantity);
    }
  const std::vector<bool> all(setup_.observers.size() + 1, true);
  for (std::size_t frame = 0; frame < frames_.count(); ++frame) {
    show(frame, stepper.state());
    if (frame == 0) observation.start();
    observation.sample(all, [&](const std::string& observer, const Sample& sample) {
      samples.add(observer, sample, stepper.state().step, stepper.state().time);
    });
  }
  return samples;
}

void check_output(const std::filesystem::path& file, bool overwrite) {
  if (belongs_to_run(file))
    throw Error(ExitCode::bad_case, file.string() + " belongs to a run: choose another --output");
  output::require_writable(file, overwrite);
}

}  // namespace

ExitCode replay_run(const PluginRegistry& registry, const ReplayOptions& options, Log& log) {
  const std::string text = stored_case(options.folder);
  Problems problems;
  const std::string name = (options.folder / "case.toml").string();
  Case source = read_case_with_observers(text, name, options.observers, options.overrides, problems);
  source.run.device = "cpu";  // what is there to look at does not need the device that made it
  const auto setup = set_up(std::move(source), registry, problems);
  if (setup->observers.empty())
    throw Error(ExitCode::bad_case,
                name +
                    " has no observers: name a case file that has some, mesogen replay DIR CASE, or add one with "
                    "--set observers.flow.type=flow_statistics");
  const auto output = options.output.empty() ? options.folder / "replay.h5" : options.output;
  check_output(output, options.overwrite);
  // Elsewhere than in the folder of the run it disturbs nobody.
  std::optional<RunLock> lock;
  if (options.output.empty()) lock.emplace(options.folder);

  const ResultsOptions results = results_options(*setup, options.folder);
  const StoredFrames frames(results);
  if (frames.count() == 0)
    throw Error(ExitCode::bad_case, options.folder.string() + " holds no frames yet: there is nothing to replay");
  log.info(fmt::format(
      "{} observers look at {} frames, from t = {} to {} {}; each observer samples all of them, whatever its interval",
      setup->observers.size(), frames.count(), rounded_text(frames.stamp(0).time),
      rounded_text(frames.stamp(frames.count() - 1).time), setup->source.units.time));
  write_samples(output, results, Replay(*setup, frames, options.folder, log).run());
  log.info("samples are in " + output.string());
  return ExitCode::done;
}

}  // namespace mesogen
