#include "schedule/executor.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/plugin/context.hpp"
#include "plugin/plugin_call.hpp"
#include "schedule/derived_name.hpp"

namespace mesogen {

namespace {

bool contains(const std::vector<std::string>& list, std::string_view what) {
  return std::find(list.begin(), list.end(), what) != list.end();
}

class ScheduledContext final : public PassContext {
 public:
  ScheduledContext(State& state, const ScheduledPass& scheduled)
      : state_(state), scheduled_(scheduled), side_(scheduled.on_device ? exec::Side::device : exec::Side::host) {}

  [[nodiscard]] bool has(std::string_view field) const override { return state_.fields.find(field) != nullptr; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return state_.kernel; }
  [[nodiscard]] const Scene& scene() const override { return state_.scene; }
  [[nodiscard]] exec::Space space() const override {
    return scheduled_.on_device ? state_.backend.space() : exec::Space{};
  }
  [[nodiscard]] const mesh::DeviceMesh* device_mesh() const override {
    return scheduled_.on_device ? state_.backend.mesh() : nullptr;
  }
  [[nodiscard]] const exec::Sharing* sharing() const override {
    return state_.ranks.several() ? &state_.ranks : nullptr;
  }
  [[nodiscard]] Index count() const override { return state_.particles.count(); }
  [[nodiscard]] const double* position(int axis) const override { return state_.particles.position[axis].on(side_); }
  [[nodiscard]] std::uint64_t positions_version() const override { return state_.order.version(); }
  [[nodiscard]] const std::int64_t* id() const override { return state_.particles.id.on(side_); }
  [[nodiscard]] double time() const override { return state_.time; }
  [[nodiscard]] double step_size() const override { return state_.step_size; }
  [[nodiscard]] std::int64_t step() const override { return state_.step; }

 protected:
  [[nodiscard]] RawField readable(std::string_view field, std::size_t element_size) const override {
    const Pass& pass = scheduled_.pass;
    if (!contains(pass.own_reads, field) && !contains(pass.neighbour_reads, field) &&
        !contains(pass.optional_reads, field))
      refuse("reads", field, "reads, reads_neighbours or reads_if_present");
    return raw(field, element_size, exec::Access::read);
  }
  [[nodiscard]] RawField writable(std::string_view field, std::size_t element_size) const override {
    if (!contains(scheduled_.pass.write_list, field) && !contains(scheduled_.pass.accumulate_list, field))
      refuse("writes", field, "writes or accumulates");
    // Also what it writes: ghosts, and what packs read behind the last particle, are for others to write.
    return raw(field, element_size, exec::Access::read_write);
  }
  void fill_neighbours(void* grid, std::size_t element_size, int dimension) const override {
    if (dimension != state_.scene.dimension || (element_size == sizeof(float)) != state_.single())
      throw Error(ExitCode::plugin_refused,
                  "it asks for neighbours of another precision or dimension: take those of its class, Real and Dim");
    // Whether they happen to be up to date for somebody else's pass does not count: a plugin that works beside one and
    // not beside another would be no plugin.
    const Pass& pass = scheduled_.pass;
    if (pass.neighbour_reads.empty() && !(pass.beside_sums && state_.order.settled()))
      throw Error(ExitCode::plugin_refused,
                  "it asks for neighbours, and declares none that it reads: name the fields that it reads at them in "
                  "the pass's reads_neighbours");
    const Neighbourhood& all = state_.neighbourhood;
    dispatch(state_.scene.precision, dimension,
             [&]<class Real, int Dim>() { all.fill(*static_cast<Neighbours<Real, Dim>*>(grid), side_); });
  }

 private:
  [[noreturn]] void refuse(const std::string& does, std::string_view field, const std::string& declarations) const {
    throw Error(ExitCode::plugin_refused, "it " + does + " the field '" + std::string(field) +
                                              "', which it did not declare: name it in the pass's " + declarations);
  }
  [[nodiscard]] RawField raw(std::string_view name, std::size_t element_size, exec::Access access) const {
    Field* const field = state_.fields.find(name);
    if (field == nullptr)
      throw Error(ExitCode::plugin_refused,
                  "it asks for the field '" + std::string(name) + "', which this scene has not: ask has() first");
    if ((element_size == sizeof(float)) == field->is_double())
      throw Error(ExitCode::plugin_refused, "it asks for the field '" + std::string(name) +
                                                "' in another precision: take that of its class, Real");
    if (field->is_double()) {
      const auto view = field->view<double>(side_, access);
      return {view.base, view.stride};
    }
    const auto view = field->view<float>(side_, access);
    return {view.base, view.stride};
  }

  State& state_;
  const ScheduledPass& scheduled_;
  exec::Side side_;  // where its code runs
};

}  // namespace

Executor::Executor(State& state, StepGraph& graph, DerivedFields& derived)
    : state_(state), graph_(graph), derived_(derived) {
  for (ScheduledPass& scheduled : graph_.passes())
    if (scheduled.pass.phase == Phase::observe) observed_.push_back({&scheduled, 0, {}});
  // Whose code runs on the host looks for neighbours there.
  state_.neighbourhood.find_blocks_for_host(
      std::any_of(graph_.passes().begin(), graph_.passes().end(), [](const ScheduledPass& scheduled) {
        const bool sums = !scheduled.pass.neighbour_reads.empty() || scheduled.pass.beside_sums;
        return !scheduled.on_device && sums && !scheduled.pruned();
      }));
}

void Executor::run(Phase phase, const std::vector<bool>& reader_due, const std::function<void()>& advance_velocity) {
  std::optional<DerivedFields::BeforeStages> before_stages;
  if (phase == Phase::begin || phase == Phase::rates) before_stages.emplace(derived_);
  const auto& order = graph_.order(phase);
  std::vector<std::size_t> due;
  for (const std::size_t n : order) {
    const ScheduledPass& scheduled = graph_.passes()[n];
    bool wanted = scheduled.for_integration;
    for (std::size_t r = 0; r < reader_due.size() && !wanted; ++r) wanted = reader_due[r] && scheduled.for_observer[r];
    if (wanted) due.push_back(n);
  }
  // Particles are sorted as the integration goes, whether or not somebody reads.
  const auto integrates = [this](std::size_t n) { return graph_.passes()[n].for_integration; };
  if (graph_.sums_pairs() && std::any_of(due.begin(), due.end(), integrates)) settle(Purpose::integration);
  // What a pass of this phase writes, others add to; the rest starts from zero.
  std::set<std::string_view> begun;
  for (const std::size_t n : due)
    for (const std::string& field : graph_.passes()[n].pass.write_list) begun.insert(field);
  const auto run_one = [&](std::size_t n) {
    ScheduledPass& scheduled = graph_.passes()[n];
    for (const std::string& field : scheduled.pass.accumulate_list)
      if (begun.insert(field).second) state_.fields.at(field).fill_zero();
    run(scheduled);
  };
  const auto rest = std::stable_partition(
      due.begin(), due.end(), [&](std::size_t n) { return !advance_velocity || graph_.before_velocity(n); });
  std::for_each(due.begin(), rest, run_one);
  if (advance_velocity) advance_velocity();
  std::for_each(rest, due.end(), run_one);
}

void Executor::run_alone(ScheduledPass& scheduled) {
  state_.order.settle();
  run(scheduled);
}

void Executor::settle(Purpose purpose) {
  purpose == Purpose::reading ? state_.order.settle_for_reader() : state_.order.settle();
}

void Executor::run(ScheduledPass& scheduled) {
  const Purpose purpose = scheduled.for_integration ? Purpose::integration : Purpose::reading;
  if (purpose == Purpose::integration) state_.order.return_to_integration();
  if (!scheduled.pass.neighbour_reads.empty()) settle(purpose);
  for (const std::string& field : scheduled.pass.own_reads) prepare(field, purpose);
  for (const std::string& field : scheduled.pass.optional_reads)
    if (state_.fields.find(field) != nullptr) prepare(field, purpose);
  for (const std::string& field : scheduled.pass.neighbour_reads) {
    prepare(field, purpose);
    state_.boundary_values.refresh(state_.fields.at(field));
  }
  const Span span(scheduled.counter, state_.clock.trace);
  const PluginCall call{.plugin = scheduled.plugin,
                        .call = "pass",
                        .subject = scheduled.pass.name,
                        .instance = scheduled.owner,
                        .step = &state_.step,
                        .time = &state_.time,
                        .time_unit = state_.units.time};
  call_plugin(call, ExitCode::run_failed, [&] {
    scheduled.pass.body(ScheduledContext(state_, scheduled));
    state_.clock.end_of_work();
  });
  for (const std::string& field : scheduled.pass.write_list)
    if (Field* const written = state_.fields.find(field)) ++written->version;
  for (const std::string& field : scheduled.pass.accumulate_list) ++state_.fields.at(field).version;
}

void Executor::prepare(const std::string& field, Purpose purpose) {
  if (derived_.prescribes(field)) return derived_.make(field);
  if (!derived_.has(field)) return;
  settle(purpose);
  derived_.make(field);
}

void Executor::prepare(const std::vector<std::string>& fields) {
  for (const std::string& field : fields) prepare_for_reader(field);
}

void Executor::prepare_for_reader(const std::string& field) {
  const auto made = std::find_if(observed_.begin(), observed_.end(), [&](const Observed& observed) {
    return contains(observed.scheduled->pass.write_list, field);
  });
  if (made != observed_.end()) return observe(*made);
  // A gradient of what is made for readers.
  if (const std::string source = derived_name(field).source; derived_.has(field) && !source.empty())
    prepare_for_reader(source);
  prepare(field, Purpose::reading);
}

// Only if particles, what it reads or what it wrote are no longer as they were: another pass may have written that.
void Executor::observe(Observed& observed) {
  const Pass& pass = observed.scheduled->pass;
  const auto bring = [&](const std::vector<std::string>& sources) {
    for (const std::string& name : sources)
      if (!contains(pass.write_list, name)) prepare_for_reader(name);
  };
  bring(pass.own_reads);
  bring(pass.neighbour_reads);
  const auto versions = [&] {
    std::map<std::string, std::uint64_t> all;
    const auto note = [&](const std::vector<std::string>& names) {
      for (const std::string& name : names)
        if (const Field* const field = state_.fields.find(name)) all[name] = field->version;
    };
    note(pass.own_reads);
    note(pass.neighbour_reads);
    note(pass.optional_reads);
    note(pass.write_list);
    return all;
  };
  if (observed.positions == state_.order.version() && observed.versions == versions()) return;
  run(*observed.scheduled);
  observed.positions = state_.order.version();
  observed.versions = versions();
}

}  // namespace mesogen
