#include "run/observation.hpp"

#include <algorithm>

#include "plugin/plugin_call.hpp"
#include "run/state_view.hpp"

namespace mesogen {

namespace {

/// Lets an observer read what it declared, and while it follows every step states alone: nothing else is brought up to
/// date for it then.
class DeclaredView final : public StateView {
 public:
  DeclaredView(const State& state, const WholeState& whole, const Setup& setup, const Setup::ObserverMember& observer,
               bool following)
      : StateView(state, whole), setup_(setup), observer_(observer), following_(following) {}

  [[nodiscard]] FieldReader field(std::string_view name) const override {
    check(name);
    return StateView::field(name);
  }
  [[nodiscard]] std::vector<double> values(std::string_view name, int component) const override {
    check(name);
    return StateView::values(name, component);
  }
  [[nodiscard]] bool has(std::string_view name) const override {
    const auto& declared = observer_.fields;
    return std::find(declared.begin(), declared.end(), name) != declared.end() && StateView::has(name);
  }

 private:
  void check(std::string_view name) const {
    const auto& declared = observer_.fields;
    const std::string reads = "it reads the field '" + std::string(name) + "'";
    if (std::find(declared.begin(), declared.end(), name) == declared.end())
      throw Error(ExitCode::plugin_refused, reads + ", which it did not declare: name it in plan()");
    if (following_ && !setup_.catalogue.outlasts_step(name))
      throw Error(ExitCode::plugin_refused, reads +
                                                " in follow(): only fields that are advanced in time are up to date "
                                                "after every step; read it in sample()");
  }

  const Setup& setup_;
  const Setup::ObserverMember& observer_;
  bool following_;
};

template <class Action>
void call(const State& state, const Setup::ObserverMember& member, const char* name, Action&& action) {
  const PluginCall call{.plugin = member.type,
                        .call = name,
                        .section = "observers.",
                        .instance = member.instance,
                        .step = &state.step,
                        .time = &state.time,
                        .time_unit = state.units.time};
  call_plugin(call, ExitCode::run_failed, std::forward<Action>(action));
}

}  // namespace

Observation::Observation(Stepper& stepper)
    : stepper_(stepper),
      whole_(stepper.state()),
      frame_values_(std::make_shared<FrameValues>(stepper.state(), whole_, stepper.setup())) {
  for (const auto& member : stepper.setup().observers) {
    sampling_.push_back({"observers." + member.instance + ": sample", "plugin"});
    following_.push_back({"observers." + member.instance + ": follow", "plugin"});
  }
}

void Observation::declare(ResultsWriter& results) const {
  for (const auto& member : stepper_.setup().observers)
    for (Quantity quantity : member.plan.quantities()) {
      quantity.unit(stepper_.state().units.text(quantity.unit_text));
      results.declare_observable(member.instance, quantity);
    }
}

void Observation::start() {
  first_step_ = stepper_.state().step;
  for (const auto& member : stepper_.setup().observers) {
    prepare(member.fields);
    if (!ranks().is_first()) continue;
    call(stepper_.state(), member, "start()",
         [&] { member.plugin->start(DeclaredView(stepper_.state(), whole_, stepper_.setup(), member, false)); });
  }
}

void Observation::follow() {
  const auto& members = stepper_.setup().observers;
  for (std::size_t n = 0; n < members.size(); ++n) {
    const auto& member = members[n];
    if (!member.plan.follows()) continue;
    const Span span(following_[n], stepper_.state().clock.trace);
    whole_.gather(member.fields);
    if (!ranks().is_first()) continue;
    call(stepper_.state(), member, "follow()",
         [&] { member.plugin->follow(DeclaredView(stepper_.state(), whole_, stepper_.setup(), member, true)); });
  }
}

Sample Observation::sample(std::size_t n) {
  const auto& member = stepper_.setup().observers[n];
  prepare(member.fields);
  const Span span(sampling_[n], stepper_.state().clock.trace);
  Sample sample;
  if (!ranks().is_first()) return sample;
  call(stepper_.state(), member, "sample()",
       [&] { member.plugin->sample(DeclaredView(stepper_.state(), whole_, stepper_.setup(), member, false), sample); });
  return sample;
}

void Observation::sample(const std::vector<bool>& due, const TakeSample& take) {
  const auto& members = stepper_.setup().observers;
  if (stepper_.state().step > first_step_) follow();
  for (std::size_t n = 0; n < members.size(); ++n)
    if (due[n]) take(members[n].instance, sample(n));
}

void Observation::observe(const std::vector<bool>& due, ResultsWriter& results) {
  if (stepper_.state().step > first_step_) follow();
  record(due, results);
}

EndRecords Observation::record_end(ResultsWriter& results) {
  const std::int64_t step = stepper_.state().step;
  EndRecords records;
  std::vector<bool> missing;
  for (const auto& member : stepper_.setup().observers) {
    missing.push_back(any(ranks(), results.writes() && results.last_sample_step(member.instance) != step));
    if (missing.back()) records.observers.insert(member.instance);
  }
  records.frame = any(ranks(), results.writes() && results.last_frame_step() != step);
  missing.push_back(records.frame);
  record(missing, results);
  return records;
}

void Observation::record(const std::vector<bool>& due, ResultsWriter& results) {
  const State& state = stepper_.state();
  const auto& members = stepper_.setup().observers;
  for (std::size_t n = 0; n < members.size(); ++n) {
    if (!due[n]) continue;
    const Sample taken = sample(n);
    if (results.writes()) results.add_sample(members[n].instance, taken, state.step, state.time);
  }
  if (!due.back()) return;
  // Passes are counted as such, wherever they run.
  prepare(stepper_.setup().output_fields);
  if (!results.writes()) return;
  const Span span(frames_, state.clock.trace);
  results.wait();  // for the frame before
  results.add_frame(take_prepared_frame(), state.step, state.time);
}

void Observation::prepare(const std::vector<std::string>& fields) {
  stepper_.executor().prepare(fields);
  whole_.gather(fields);
}

TakenFrame Observation::take_frame() {
  prepare(stepper_.setup().output_fields);
  return take_prepared_frame();
}

TakenFrame Observation::take_prepared_frame() {
  frame_values_->take();
  return {frame_values_->fields(), [values = frame_values_](std::vector<FrameField>& fields) { values->fill(fields); }};
}

std::vector<FrameField> Observation::frame() {
  TakenFrame taken = take_frame();
  taken.fill(taken.fields);
  return std::move(taken.fields);
}

std::vector<Counter> Observation::counters() const {
  std::vector<Counter> all = {frames_};
  for (const auto& counters : {sampling_, following_}) all.insert(all.end(), counters.begin(), counters.end());
  return all;
}

void Observation::save(Checkpoint& checkpoint) const {
  if (!ranks().is_first()) return;
  for (const auto& member : stepper_.setup().observers)
    call(stepper_.state(), member, "save()", [&] { checkpoint.observers[member.instance] = member.plugin->save(); });
}

void Observation::restore(const Checkpoint& checkpoint) {
  if (!ranks().is_first()) return;
  for (const auto& member : stepper_.setup().observers) {
    const auto at = checkpoint.observers.find(member.instance);
    if (at == checkpoint.observers.end())
      throw Error(ExitCode::bad_case,
                  "the checkpoint knows no observer '" + member.instance + "': it belongs to another case");
    call(stepper_.state(), member, "restore()", [&] { member.plugin->restore(at->second); });
  }
}

}  // namespace mesogen
