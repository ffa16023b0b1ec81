#include "schedule/derived_fields.hpp"

#include <algorithm>

#include "mesogen/exec/dispatch.hpp"
#include "schedule/derived_name.hpp"
#include "sph/fixed_weights.hpp"
#include "sph/pair_loops.hpp"

namespace mesogen {

namespace {

constexpr std::size_t most_components = 4;

template <class Pass>
bool wants_laplacian(const Pass& pass) {
  return std::ranges::any_of(pass.components, [](const auto& one) { return one.laplacian != nullptr; });
}

}  // namespace

struct DerivedFields::Weights {
  virtual ~Weights() = default;
  bool laplacian = false;
  bool gradient = false;
  std::uint64_t positions = 0;  // version of the neighbourhood that they belong to
};

template <class Real, int Dim>
struct DerivedFields::WeightsOf final : Weights {
  sph::FixedWeights<Real, Dim> fixed;
};

DerivedFields::~DerivedFields() = default;

DerivedFields::DerivedFields(State& state, const Catalogue& catalogue, const std::set<std::string>& for_integration,
                             const std::vector<std::set<std::string>>& for_readers, const Form& form,
                             PrescribedFields* prescribed)
    : state_(state), prescribed_(prescribed), form_(form) {
  std::set<std::string> all = for_integration;
  for (const auto& reader : for_readers) all.insert(reader.begin(), reader.end());
  if (all.empty()) return;

  state_.add_field("volume", 1, false).kind = catalogue.kind("volume", "");
  PairPass volume;
  volume.volume = true;
  volume.counter.title = "framework: volume";
  passes_.push_back(std::move(volume));
  pass_of_["volume"] = {0};
  for (const std::string& field : all)
    if (field != "volume") state_.add_field(field, catalogue.components(field), false).kind = catalogue.kind(field, "");
  for (const std::string& field : all) state_.fields.at(field).follows_positions = true;

  const auto note = [](Wanted& wanted, const std::string& field) {
    const DerivedName derived = derived_name(field);
    auto& [gradient, laplacian] = wanted[derived.source];
    (derived.kind == DerivedName::Kind::gradient ? gradient : laplacian) = true;
  };
  Wanted shared;
  std::vector<std::string> alone;
  for (const std::string& field : for_integration) {
    if (field == "volume" || field == "correction") continue;
    if (catalogue.is_state(derived_name(field).source)) {
      note(shared, field);
    } else {
      alone.push_back(field);
    }
  }
  // A device computes a weight faster than it reads one.
  if (state_.backend.on_host() && (form_.stages || !form_.particles_move))
    weights_ = dispatch(
        state_.scene.precision, state_.scene.dimension,
        []<class Real, int Dim>() -> std::unique_ptr<Weights> { return std::make_unique<WeightsOf<Real, Dim>>(); });
  if (weights_) weights_->laplacian = form_.stages;
  add_passes(shared, for_integration.contains("correction"), true);
  // Always the same pass, whoever asks for it first: observing is to leave no trace.
  const auto finds = std::ranges::find_if(passes_, [](const PairPass& pass) {
    return !pass.volume && !pass.by_weights && !wants_laplacian(pass) &&
           sph::made_beside_weights(static_cast<int>(pass.components.size()));
  });
  if (form_.stages && weights_ && finds != passes_.end()) finds->finds_weights = true;
  for (const std::string& field : all)
    if (!for_integration.contains(field)) alone.push_back(field);
  for (const std::string& field : alone) {
    if (pass_of_.contains(field)) continue;
    Wanted wanted;
    if (field != "correction") note(wanted, field);
    add_passes(wanted, field == "correction", for_integration.contains(field));
  }
}

void DerivedFields::add_passes(const Wanted& wanted, bool correction, bool at_each_step) {
  std::vector<Component> components;
  for (const auto& [source, kinds] : wanted) {
    Field& field = state_.fields.at(source);
    Field* const gradient = kinds.first ? &state_.fields.at(source + "_gradient") : nullptr;
    Field* const laplacian = kinds.second ? &state_.fields.at(source + "_laplacian") : nullptr;
    for (int c = 0; c < field.components(); ++c) components.push_back({&field, c, gradient, laplacian});
  }
  for (std::size_t from = 0; from < components.size() || correction; from += most_components) {
    PairPass pass;
    for (std::size_t n = from; n < std::min(from + most_components, components.size()); ++n)
      pass.components.push_back(components[n]);
    std::set<std::string> made;
    if (correction) {
      pass.correction = &state_.fields.at("correction");
      made.insert("correction");
      correction = false;
    }
    for (const Component& component : pass.components) {
      if (component.gradient != nullptr) made.insert(component.gradient->name());
      if (component.laplacian != nullptr) made.insert(component.laplacian->name());
    }
    for (const std::string& field : made) {
      pass_of_[field].push_back(passes_.size());
      pass.counter.title += (pass.counter.title.empty() ? "" : ", ") + field;
    }
    pass.sources.assign(pass.components.size(), 0);
    pass.by_weights = weights_ && at_each_step && !form_.particles_move && !pass.components.empty();
    for (const Component& component : pass.components) {
      if (!pass.by_weights) continue;
      weights_->laplacian = weights_->laplacian || component.laplacian != nullptr;
      weights_->gradient = weights_->gradient || component.gradient != nullptr;
    }
    pass.counter.title.insert(0, "framework: ");
    passes_.push_back(std::move(pass));
  }
}

bool DerivedFields::stale(const PairPass& pass) const {
  if (pass.positions != state_.neighbourhood.version()) return true;
  for (std::size_t n = 0; n < pass.components.size(); ++n)
    if (pass.sources[n] != pass.components[n].source->version) return true;
  return false;
}

void DerivedFields::make(const std::string& field) {
  if (prescribes(field)) return prescribed_->make(field);
  for (const std::size_t n : pass_of_.at(field)) {
    // A gradient of a gradient: its source first.
    for (const Component& component : passes_[n].components) {
      const std::string& source = component.source->name();
      if (has(source) || prescribes(source)) make(source);
    }
    if (stale(passes_[n])) run(passes_[n]);
  }
}

void DerivedFields::run(PairPass& pass) {
  if (!pass.volume) make("volume");
  if (!pass.volume) state_.boundary_values.refresh(state_.fields.at("volume"));
  for (const Component& component : pass.components) state_.boundary_values.refresh(*component.source);
  const Span span(pass.counter, state_.clock.trace);
  dispatch(state_.scene.precision, state_.scene.dimension,
           [&]<class Real, int Dim>() { run_pair_sums<Real, Dim>(pass); });
  state_.clock.end_of_work();
  const bool new_positions = pass.positions != state_.neighbourhood.version();
  pass.positions = state_.neighbourhood.version();
  for (std::size_t n = 0; n < pass.components.size(); ++n) {
    const Component& component = pass.components[n];
    if (!new_positions && pass.sources[n] == component.source->version) continue;
    pass.sources[n] = component.source->version;
    if (component.gradient != nullptr) ++component.gradient->version;
    if (component.laplacian != nullptr) ++component.laplacian->version;
  }
  if (pass.correction != nullptr && new_positions) ++pass.correction->version;
  if (pass.volume) ++state_.fields.at("volume").version;
}

template <class Real, int Dim>
void DerivedFields::run_pair_sums(PairPass& pass) {
  constexpr auto device = exec::Side::device;
  // Ghosts keep what they have.
  const auto write = [](Field& field) { return field.view<Real>(device, exec::Access::read_write); };
  Neighbours<Real, Dim> neighbours{};
  state_.neighbourhood.fill(neighbours, device);
  const exec::PairLoops<Real>& loops = state_.backend.pairs<Real>();
  Field& volume = state_.fields.at("volume");
  if (pass.volume) return loops.volumes(neighbours, state_.kernel, write(volume));
  sph::Derivatives<Real, Dim> wanted{};
  wanted.volume = std::as_const(volume).view<Real>(device);
  const bool new_positions = pass.positions != state_.neighbourhood.version();
  for (std::size_t c = 0; c < pass.components.size(); ++c) {
    const Component& component = pass.components[c];
    if (!new_positions && pass.sources[c] == component.source->version) continue;
    const int n = wanted.count++;
    wanted.source[n] = std::as_const(*component.source).view<Real>(device).component(component.index);
    if (component.gradient != nullptr)
      for (int d = 0; d < Dim; ++d)
        wanted.gradient[n][d] = write(*component.gradient).component(component.index * Dim + d);
    if (component.laplacian != nullptr) wanted.laplacian[n] = write(*component.laplacian).component(component.index);
  }
  wanted.consistent = form_.consistent_laplacian;
  if (pass.correction != nullptr && new_positions) wanted.correction = write(*pass.correction);
  const bool gradients_alone = !pass.by_weights && !wants_laplacian(pass);
  if (gradients_alone && !new_positions && pass.correction != nullptr && wanted.count <= 2)
    return loops.gradients(neighbours, state_.kernel, wanted, std::as_const(*pass.correction).view<Real>(device));
  if (stages_follow_ && pass.finds_weights && new_positions) return find_weights(neighbours, wanted);
  if (!pass.by_weights || wanted.correction) loops.derivatives(neighbours, state_.kernel, wanted);
  if (pass.by_weights) sph::derivatives<Real, Dim>(exec::Space{}, neighbours, weights(neighbours), wanted);
}

void DerivedFields::refresh_for_sums(Field& source) {
  make("volume");
  state_.boundary_values.refresh(state_.fields.at("volume"));
  state_.boundary_values.refresh(source);
}

template <class Real>
void DerivedFields::stage(Field& latest, exec::StageArguments<Real> arguments, Field& room) {
  if (!weights_) laplacian(latest, room);
  if (weights_) refresh_for_sums(latest);
  // What stands at walls may be made on the host: only now is there a pointer that holds.
  arguments.latest = std::as_const(latest).view<Real>(exec::Side::device);
  if (!weights_)
    return state_.backend.fields<Real>().stage(arguments, std::as_const(room).view<Real>(exec::Side::device),
                                               state_.particles.count());
  const Span span(staging_, state_.clock.trace);
  dispatch(state_.scene.dimension, [&]<int Dim>() {
    Neighbours<Real, Dim> neighbours{};
    state_.neighbourhood.fill(neighbours, exec::Side::host);
    sph::stage<Real, Dim>(neighbours, weights(neighbours), arguments);
  });
}

template void DerivedFields::stage(Field& latest, exec::StageArguments<float> arguments, Field& room);
template void DerivedFields::stage(Field& latest, exec::StageArguments<double> arguments, Field& room);

void DerivedFields::laplacian(Field& source, Field& result) {
  refresh_for_sums(source);
  const Span span(staging_, state_.clock.trace);
  dispatch(state_.scene.precision, state_.scene.dimension,
           [&]<class Real, int Dim>() { run_laplacian<Real, Dim>(source, result); });
  state_.clock.end_of_work();
  ++result.version;
}

template <class Real, int Dim>
void DerivedFields::run_laplacian(Field& source, Field& result) {
  constexpr auto device = exec::Side::device;
  Neighbours<Real, Dim> neighbours{};
  state_.neighbourhood.fill(neighbours, device);
  sph::Derivatives<Real, Dim> wanted{};
  wanted.volume = std::as_const(state_.fields.at("volume")).view<Real>(device);
  wanted.consistent = form_.consistent_laplacian;
  for (int c = 0; c < source.components(); ++c) {
    const int n = wanted.count++;
    wanted.source[n] = std::as_const(source).view<Real>(device).component(c);
    wanted.laplacian[n] = result.view<Real>(device, exec::Access::read_write).component(c);
  }
  if (weights_) {
    sph::derivatives<Real, Dim>(exec::Space{}, neighbours, weights(neighbours), wanted);
  } else {
    state_.backend.pairs<Real>().derivatives(neighbours, state_.kernel, wanted);
  }
}

bool DerivedFields::weights_stale() const {
  return weights_ != nullptr && weights_->positions != state_.neighbourhood.version();
}

template <class Real, int Dim>
void DerivedFields::find_weights(const Neighbours<Real, Dim>& neighbours, const sph::Derivatives<Real, Dim>& beside) {
  sph::find_weights<Real, Dim>(neighbours, state_.kernel, {weights_->laplacian, weights_->gradient}, beside,
                               static_cast<WeightsOf<Real, Dim>&>(*weights_).fixed);
  weights_->positions = state_.neighbourhood.version();
}

template <class Real, int Dim>
const sph::FixedWeights<Real, Dim>& DerivedFields::weights(const Neighbours<Real, Dim>& neighbours) {
  if (weights_stale()) {
    const Span span(finding_, state_.clock.trace);
    sph::Derivatives<Real, Dim> none{};
    none.volume = std::as_const(state_.fields.at("volume")).view<Real>(exec::Side::device);
    none.consistent = form_.consistent_laplacian;
    find_weights(neighbours, none);
  }
  return static_cast<WeightsOf<Real, Dim>&>(*weights_).fixed;
}

std::vector<Counter> DerivedFields::counters() const {
  std::vector<Counter> all;
  for (const PairPass& pass : passes_) all.push_back(pass.counter);
  if (finding_.runs > 0) all.push_back(finding_);
  if (form_.stages) all.push_back(staging_);
  return all;
}

}  // namespace mesogen
