#include "case_run.hpp"

#include <cmath>
#include <numbers>
#include <span>

#include "run/state_view.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {

namespace {

std::vector<double> by_id(std::span<const std::int64_t> id, const std::vector<double>& stored) {
  std::vector<double> values(stored.size());
  for (std::size_t i = 0; i < stored.size(); ++i) values[static_cast<std::size_t>(id[i])] = stored[i];
  return values;
}

}  // namespace

CaseRun::CaseRun(const CaseText& text, const std::vector<std::string>& settings) : CaseRun(text, settings, true) {}

CaseRun CaseRun::unstarted(const CaseText& text) { return {text, {}, false}; }

CaseRun::CaseRun(const CaseText& text, const std::vector<std::string>& settings, bool start) {
  Problems problems;
  Case source = read_case_text(text.text(), "test.toml", settings, problems);
  setup_ = set_up(std::move(source), built_plugins(), problems);
  stepper_ = std::make_unique<Stepper>(*setup_);
  nobody_.assign(setup_->observers.size() + 1, false);
  if (start) stepper_->start();
}

void CaseRun::run_to(double time) {
  while (state().time < time) stepper_->advance(stepper_->next_step(time), nobody_);
}

void CaseRun::run_steps(int steps) {
  for (int n = 0; n < steps; ++n) stepper_->advance(stepper_->next_step(setup_->source.time.end), nobody_);
}

std::vector<double> CaseRun::field(const std::string& name, int component) {
  stepper_->executor().prepare(std::vector{name});
  return by_id(state().particles.id.host(), StateView(state()).values(name, component));
}

std::vector<double> CaseRun::path(int axis) {
  return by_id(state().particles.id.host(), StateView(state()).unwrapped(axis));
}

Sample CaseRun::sample(const std::string& name) {
  const auto observer = built_plugins().make_observer(name, 2);
  ParameterList list;
  observer->parameters(list);
  ObserverPlan plan;
  observer->plan(state().scene, plan);
  stepper_->executor().prepare(
      plan.fields([this](const std::string& field) { return state().fields.find(field) != nullptr; }));
  Sample sample;
  const StateView view(state());
  observer->start(view);
  observer->sample(view, sample);
  return sample;
}

double CaseRun::observe(const std::string& observer, const std::string& quantity) {
  return sample(observer).values().at(quantity).at(0);
}

Wave wave_of(CaseRun& run, const std::vector<double>& values, int mx, int my) {
  const double k = 2.0 * std::numbers::pi / run.state().scene.box[0];
  const auto x = run.path(0);
  const auto y = run.path(1);
  Wave wave{0.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double phase = k * (mx * x[i] + my * y[i]);
    wave.cosine += 2.0 * values[i] * std::cos(phase) / static_cast<double>(values.size());
    wave.sine += 2.0 * values[i] * std::sin(phase) / static_cast<double>(values.size());
  }
  return wave;
}

}  // namespace mesogen::test
