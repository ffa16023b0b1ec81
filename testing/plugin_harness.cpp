#include "mesogen/testing/plugin_harness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "harness_run.hpp"
#include "run/state_view.hpp"
#include "scene_text.hpp"
#include "test_registry.hpp"

namespace mesogen::testing {

/// What the test said so far, and the scene once it is needed.
class PluginHarness::Implementation {
 public:
  Implementation(std::optional<PluginKind> kind, std::string text, const std::map<std::string, double>& constants,
                 std::string_view folders)
      : kind_(kind), text_(std::move(text)), constants_(constants), registry_(registry_of(folders)) {}

  HarnessRun& run() {
    if (!run_) {
      run_ = std::make_unique<HarnessRun>(text_, registry_, given_, constants_, seed_);
      run_->state().step_size = step_size_;
    }
    return *run_;
  }
  HarnessRun& running() {
    run().touched = true;
    return run();
  }

  void set(std::string_view field, GivenField given) {
    const std::string name(field);
    if (run_ && !run_->touched) run_.reset();
    if (run_ && !run_->set(name, given))
      throw Error(ExitCode::bad_case,
                  fmt::format("the scene has no field '{}' of its own: set it before anything runs", name));
    given_.insert_or_assign(name, std::move(given));
  }

  void set_component(std::string_view field, int component, std::vector<double> values) {
    const std::string name(field);
    GivenField given;
    if (const auto at = given_.find(name); at != given_.end()) given = at->second;
    given.components = std::max(given.components, component + 1);
    given.value = [component, values = std::move(values), others = given.value](int c, std::int64_t id, double x,
                                                                                double y) {
      if (c == component) return values.at(static_cast<std::size_t>(id));
      return others ? others(c, id, x, y) : 0.0;
    };
    given_.insert_or_assign(name, given);
    // Components come one by one: the field is whole when it is used.
    if (!run_) return;
    if (!run_->touched) return run_.reset();
    run_->set(name, given);
  }

  void seed(std::int64_t seed) {
    seed_ = seed;
    if (run_) run_->seed(seed);
  }
  void set_step_size(double seconds) {
    step_size_ = seconds;
    if (run_) run_->state().step_size = seconds;
  }
  void shuffle(std::int64_t seed) { shuffled_by_ = seed; }
  [[nodiscard]] std::optional<std::int64_t> shuffled_by() const { return shuffled_by_; }

  void require(PluginKind kind, bool there) const {
    if (!there || (kind_ && *kind_ != kind))
      throw Error(ExitCode::bad_case, fmt::format("this harness tests no {} plugin", to_string(kind)));
  }

 private:
  std::optional<PluginKind> kind_;
  std::string text_;
  std::map<std::string, double> constants_;
  const PluginRegistry& registry_;
  GivenFields given_;
  std::int64_t seed_ = 1;
  double step_size_ = 0.0;
  std::optional<std::int64_t> shuffled_by_;
  std::unique_ptr<HarnessRun> run_;
};

PluginHarness::PluginHarness(PluginKind kind, std::string_view name, std::string_view keys, const TestScene& scene,
                             std::string_view folders)
    : implementation_(std::make_unique<Implementation>(kind, scene_text(kind, name, keys, scene, registry_of(folders)),
                                                       scene.constants, folders)) {}

PluginHarness::PluginHarness(std::string_view case_text, std::string_view folders)
    : implementation_(std::make_unique<Implementation>(std::nullopt, std::string(case_text),
                                                       std::map<std::string, double>(), folders)) {}

PluginHarness::PluginHarness(PluginHarness&&) noexcept = default;
PluginHarness::~PluginHarness() = default;

PluginHarness& PluginHarness::set(std::string_view field, std::initializer_list<double> components) {
  const std::vector<double> all(components);
  implementation_->set(field, {static_cast<int>(all.size()), [all](int c, std::int64_t, double, double) {
                                 return all[static_cast<std::size_t>(c)];
                               }});
  return *this;
}

PluginHarness& PluginHarness::set(std::string_view field, std::initializer_list<Function> components) {
  const std::vector<Function> all(components);
  implementation_->set(field, {static_cast<int>(all.size()), [all](int c, std::int64_t, double x, double y) {
                                 return all[static_cast<std::size_t>(c)](x, y);
                               }});
  return *this;
}

PluginHarness& PluginHarness::give(std::string_view field) {
  implementation_->set(field, {});
  return *this;
}

PluginHarness& PluginHarness::set_values(std::string_view field, int component, std::vector<double> values) {
  implementation_->set_component(field, component, std::move(values));
  return *this;
}

PluginHarness& PluginHarness::seed(std::int64_t seed) {
  implementation_->seed(seed);
  return *this;
}

PluginHarness& PluginHarness::set_step_size(double seconds) {
  implementation_->set_step_size(seconds);
  return *this;
}

PluginHarness& PluginHarness::shuffle(std::int64_t seed) {
  implementation_->shuffle(seed);
  return *this;
}

PluginHarness& PluginHarness::move(const Function& x, const Function& y) {
  implementation_->run().move(x, y);
  return *this;
}

void PluginHarness::run(std::string_view pass) {
  HarnessRun& run = implementation_->running();
  run.stepper().executor().run_alone(run.scheduled(pass));
}

void PluginHarness::run(Phase phase) {
  HarnessRun& run = implementation_->running();
  run.stepper().executor().run(phase, run.all_readers());
}

void PluginHarness::start() { implementation_->run().start(); }

void PluginHarness::step(int steps) {
  for (int n = 0; n < steps; ++n) implementation_->run().step(implementation_->run().setup().source.time.end);
}

void PluginHarness::run_until(double seconds) {
  while (time() < seconds) implementation_->run().step(seconds);
}

PluginHarness::Quantities PluginHarness::sample() {
  return implementation_->running().sample(implementation_->shuffled_by());
}

void PluginHarness::resume_from(PluginHarness& other) {
  implementation_->running().resume_from(other.implementation_->running());
}

void PluginHarness::restore(const std::map<std::string, std::vector<double>>& saved, double time) {
  (void)observer();
  implementation_->run().restore(saved, time);
}

std::vector<double> PluginHarness::values(std::string_view field, int component) {
  return implementation_->run().values(std::string(field), component);
}

double PluginHarness::value(std::string_view field, int component, std::int64_t particle) {
  return values(field, component).at(static_cast<std::size_t>(particle));
}

std::vector<double> PluginHarness::position(int axis) {
  HarnessRun& run = implementation_->run();
  return run.by_id(StateView(run.state()).position(axis));
}

std::vector<double> PluginHarness::path(int axis) {
  HarnessRun& run = implementation_->run();
  return run.by_id(StateView(run.state()).unwrapped(axis));
}

double PluginHarness::time() { return implementation_->run().state().time; }

std::int64_t PluginHarness::particles() { return implementation_->run().state().particles.count(); }

Scene PluginHarness::scene() { return implementation_->run().setup().scene; }

sph::SmoothingKernel PluginHarness::smoothing() { return implementation_->run().setup().smoothing; }

std::map<std::string, double> PluginHarness::step_limits() {
  std::map<std::string, double> limits;
  for (const auto& limit : implementation_->run().setup().limits.all()) limits[limit.text] = limit.seconds;
  return limits;
}

std::vector<std::string> PluginHarness::fields() { return implementation_->run().setup().output_fields; }

int PluginHarness::components(std::string_view field) {
  return implementation_->run().setup().catalogue.components(field);
}

Kernel& PluginHarness::kernel() {
  implementation_->require(PluginKind::kernel, true);
  return *implementation_->run().setup().kernel;
}

Boundary& PluginHarness::boundary() {
  implementation_->require(PluginKind::boundary, true);
  return *implementation_->run().setup().boundary;
}

Shape& PluginHarness::shape() {
  auto* const confined = implementation_->run().setup().confined;
  implementation_->require(PluginKind::shape, confined != nullptr);
  return confined->solids().front().shape();
}

Initial& PluginHarness::initial() {
  auto& members = implementation_->run().setup().initial;
  implementation_->require(PluginKind::initial, !members.empty());
  return *members.front().plugin;
}

Physics& PluginHarness::physics() {
  auto& members = implementation_->run().setup().physics;
  implementation_->require(PluginKind::physics, !members.empty());
  return *members.front().plugin;
}

Observer& PluginHarness::observer() {
  auto& members = implementation_->run().setup().observers;
  implementation_->require(PluginKind::observer, !members.empty());
  return *members.front().plugin;
}

const PassList& PluginHarness::passes() {
  auto& members = implementation_->run().setup().physics;
  implementation_->require(PluginKind::physics, !members.empty());
  return members.front().passes;
}

const InitialPlan& PluginHarness::initial_plan() {
  auto& members = implementation_->run().setup().initial;
  implementation_->require(PluginKind::initial, !members.empty());
  return members.front().plan;
}

const ObserverPlan& PluginHarness::plan() {
  auto& members = implementation_->run().setup().observers;
  implementation_->require(PluginKind::observer, !members.empty());
  return members.front().plan;
}

}  // namespace mesogen::testing
