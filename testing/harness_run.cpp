#include "harness_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "mesogen/exec/random.hpp"
#include "run/state_view.hpp"

namespace mesogen::testing {

namespace {

std::unique_ptr<Setup> put_together(const std::string& text, const PluginRegistry& registry, const GivenFields& given,
                                    const std::map<std::string, double>& constants) {
  Problems problems;
  Case source = read_case_text(text, "the test's case", {}, problems);
  return set_up(std::move(source), registry, problems, SceneCompletion(registry, given, constants).additions());
}

/// A stream of random numbers of its own for each component of each field, whatever other fields there are.
std::int64_t stream_of(std::string_view field, int component) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : field) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return static_cast<std::int64_t>((hash >> 8U) + static_cast<std::uint64_t>(component));
}

}  // namespace

HarnessRun::HarnessRun(const std::string& case_text, const PluginRegistry& registry, const GivenFields& given,
                       const std::map<std::string, double>& constants, std::int64_t seed_of_fields)
    : setup_(put_together(case_text, registry, given, constants)), stepper_(*setup_), observation_(stepper_) {
  state().order.settle();
  seed(seed_of_fields);
  for (const auto& [name, field] : given) set(name, field);
}

std::set<std::string> HarnessRun::seeded_fields() const {
  std::set<std::string> fields;
  for (const auto& [name, entry] : setup_->catalogue.all())
    if (setup_->catalogue.outlasts_step(name) && !given_.contains(name)) fields.insert(name);
  for (const auto& member : setup_->initial)
    for (const FieldDeclaration& field : member.plan.fields()) fields.erase(field.name);
  return fields;
}

void HarnessRun::seed(std::int64_t seed) {
  for (const std::string& name : seeded_fields()) {
    const auto& declared = setup_->catalogue.find(name)->declaration;
    const double width = declared.advance == Advance::never ? 1.0 : 0.1;
    const double middle = declared.advance == Advance::never && declared.rank == Rank::scalar ? 1.0 : 0.0;
    fill(name, [&](int component, std::int64_t id, double, double) {
      return middle + width * (exec::random_uniform(seed, id, stream_of(name, component)) - 0.5);
    });
  }
}

void HarnessRun::fill(const std::string& name, const FieldValue& value) {
  Field& field = state().fields.at(name);
  const auto x = StateView(state()).position(0);
  const auto y = StateView(state()).position(1);
  const auto id = state().particles.id.host();
  for (int c = 0; c < field.components(); ++c)
    for (std::size_t i = 0; i < id.size(); ++i) field.set(c, static_cast<Index>(i), value(c, id[i], x[i], y[i]));
  ++field.version;
}

bool HarnessRun::set(const std::string& name, const GivenField& given) {
  const Field* const field = state().fields.find(name);
  if (field == nullptr || setup_->catalogue.find(name) == nullptr) return false;
  if (!given.value) return true;
  if (field->components() != given.components)
    throw Error(ExitCode::bad_case, fmt::format("the field '{}' has {} components here, but {} are given", name,
                                                field->components(), given.components));
  given_.insert(name);
  fill(name, given.value);
  return true;
}

void HarnessRun::start() {
  if (started_) return;
  started_ = touched = true;
  stepper_.start();
  observation_.start();
}

void HarnessRun::restore(const std::map<std::string, std::vector<double>>& saved, double time) {
  start();
  stepper_.state().time = time;
  Checkpoint checkpoint;
  checkpoint.observers[setup_->observers.front().instance] = saved;
  observation_.restore(checkpoint);
}

void HarnessRun::resume_from(HarnessRun& other) {
  start();
  Checkpoint checkpoint;
  other.stepper_.save(checkpoint);
  other.observation_.save(checkpoint);
  stepper_.restore(checkpoint);
  observation_.restore(checkpoint);
}

void HarnessRun::step(double end) {
  start();
  const Stepper::Step step = stepper_.next_step(end);
  if (step.seconds > 1e5)
    throw Error(ExitCode::bad_case, "nothing limits the step in this scene: give TestScene::step");
  stepper_.advance(step, all_readers());
  observation_.follow();
}

std::map<std::string, std::vector<double>, std::less<>> HarnessRun::sample(std::optional<std::int64_t> shuffled_by) {
  start();
  if (setup_->observers.empty()) throw Error(ExitCode::bad_case, "there is no observer in this scene to sample");
  const auto& member = setup_->observers.front();
  // Fields are up to date before particles are stored anew, so nothing is computed in the wrong order.
  stepper_.executor().prepare(member.fields);
  std::vector<Index> order(state().particles.id.size());
  std::iota(order.begin(), order.end(), 0);
  if (shuffled_by)
    for (std::size_t n = order.size(); n > 1; --n)
      std::swap(order[n - 1],
                order[static_cast<std::size_t>(exec::random_bits(*shuffled_by, static_cast<int>(n), 0) % n)]);
  permute(order);
  const auto values = observation_.sample(0).values();
  std::vector<Index> back(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) back[static_cast<std::size_t>(order[n])] = static_cast<Index>(n);
  permute(back);

  const std::string who = fmt::format("observer '{}'", member.instance);
  for (const Quantity& quantity : member.plan.quantities()) {
    const auto found = values.find(quantity.name);
    if (found == values.end())
      throw Error(ExitCode::plugin_refused,
                  fmt::format("{} planned '{}' and did not sample it: set() it in sample()", who, quantity.name));
    const std::size_t size = found->second.size();
    if (quantity.columns == 0 ? size != 1 : size % quantity.columns != 0)
      throw Error(ExitCode::plugin_refused,
                  fmt::format("{} sampled {} numbers of '{}', which has {}", who, size, quantity.name,
                              quantity.columns == 0 ? "one" : fmt::format("rows of {}", quantity.columns)));
  }
  for (const auto& [name, sampled] : values)
    if (std::ranges::none_of(member.plan.quantities(), [&name = name](const Quantity& q) { return q.name == name; }))
      throw Error(ExitCode::plugin_refused,
                  fmt::format("{} sampled '{}', which it did not plan: name it in plan()", who, name));
  return values;
}

void HarnessRun::permute(const std::vector<Index>& order) {
  const auto reorder = [&](auto& array) {
    const auto values = array.host(exec::Access::read_write);
    const std::vector before(values.begin(), values.end());
    for (std::size_t n = 0; n < order.size(); ++n) values[n] = before[static_cast<std::size_t>(order[n])];
  };
  Particles& particles = state().particles;
  reorder(particles.id);
  for (int d = 0; d < particles.dimension; ++d) {
    reorder(particles.position[d]);
    reorder(particles.images[d]);
  }
  exec::DeviceMemory* const memory = state().backend.memory();
  exec::Array<Index> from(memory);
  from.assign(order);
  Field::Scratch scratch(memory);
  for (const auto& [name, field] : state().fields.all()) field->permute(from, scratch);
}

std::vector<double> HarnessRun::by_id(const std::vector<double>& stored) {
  const auto id = state().particles.id.host();
  std::vector<double> values(stored.size());
  for (std::size_t i = 0; i < stored.size(); ++i) values[static_cast<std::size_t>(id[i])] = stored[i];
  return values;
}

std::vector<double> HarnessRun::values(const std::string& name, int component) {
  stepper_.executor().prepare(std::vector{name});
  const Field* const field = state().fields.find(name);
  if (field == nullptr)
    throw Error(ExitCode::bad_case,
                fmt::format("this scene has no field '{}' (it has: {})", name, fmt::join(setup_->output_fields, ", ")));
  if (component < 0 || component >= field->components())
    throw Error(ExitCode::bad_case, fmt::format("the field '{}' has the components 0 to {}, not {}", name,
                                                field->components() - 1, component));
  return by_id(StateView(state()).values(name, component));
}

void HarnessRun::move(const std::function<double(double, double)>& x, const std::function<double(double, double)>& y) {
  state().order.return_to_integration();
  Particles& particles = state().particles;
  const auto at_x = StateView(state()).position(0);
  const auto at_y = StateView(state()).position(1);
  const auto to_x = particles.position[0].host(exec::Access::read_write);
  const auto to_y = particles.position[1].host(exec::Access::read_write);
  for (std::size_t i = 0; i < at_x.size(); ++i) {
    to_x[i] += x(at_x[i], at_y[i]);
    to_y[i] += y(at_x[i], at_y[i]);
  }
  touched = true;
  state().order.mark_moved();
  state().order.settle();
}

ScheduledPass& HarnessRun::scheduled(std::string_view pass) {
  std::vector<std::string> titles;
  for (ScheduledPass& scheduled : setup_->graph->passes()) {
    titles.push_back(scheduled.pass.name);
    if (scheduled.pass.name == pass || scheduled.title() == pass) return scheduled;
  }
  throw Error(ExitCode::bad_case,
              fmt::format("there is no pass '{}' in this scene (there are: {})", pass, fmt::join(titles, ", ")));
}

}  // namespace mesogen::testing
