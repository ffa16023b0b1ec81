#include "run/kept_momentum.hpp"

#include <algorithm>
#include <cstddef>

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/exact_sum.hpp"
#include "particles/field_loops.hpp"

namespace mesogen {

namespace {

// What a few steps leave is far below what anybody can see, and to look for it at every step would cost two per cent.
constexpr std::int64_t steps_between = 8;

const std::string name = "mean velocity";  // in checkpoints

bool adds_to(const ScheduledPass& scheduled, const std::string& field) {
  const auto has = [&](const std::vector<std::string>& list) { return std::ranges::find(list, field) != list.end(); };
  return !scheduled.pruned() && (has(scheduled.pass.accumulate_list) || has(scheduled.pass.write_list));
}

}  // namespace

bool conserves_momentum(const Setup& setup) {
  const std::string& velocity = setup.graph->transport().velocity;
  const Catalogue::Entry* const entry = velocity.empty() ? nullptr : setup.catalogue.find(velocity);
  if (entry == nullptr || !has_rate(entry->declaration.advance)) return false;
  if (!setup.scene.endless()) return false;
  const auto conserves = [&](const ScheduledPass& scheduled) {
    return !adds_to(scheduled, entry->declaration.rate) || scheduled.pass.no_net_force;
  };
  return std::ranges::all_of(setup.graph->passes(), conserves);
}

KeptMomentum::KeptMomentum(const Setup& setup, State& state) : state_(state), parts_(state.backend.memory()) {
  if (conserves_momentum(setup)) velocity_ = &state.fields.at(setup.graph->transport().velocity);
}

void KeptMomentum::start() {
  if (velocity_ != nullptr) kept_ = mean();
}

bool KeptMomentum::due() const { return velocity_ != nullptr && state_.step % steps_between == 0; }

void KeptMomentum::keep() {
  std::vector<double> change = mean();
  for (std::size_t c = 0; c < change.size(); ++c) change[c] = kept_[c] - change[c];
  dispatch(state_.scene.precision, [&]<class Real>() { add<Real>(change); });
  ++velocity_->version;
}

void KeptMomentum::save(Checkpoint& checkpoint) const {
  if (velocity_ != nullptr) checkpoint.numbers[name] = kept_;
}

// A run that branched off one with other forces keeps the momentum that it got from there.
void KeptMomentum::restore(const Checkpoint& checkpoint) {
  if (velocity_ == nullptr) return;
  const auto at = checkpoint.numbers.find(name);
  kept_ = at == checkpoint.numbers.end() ? mean() : at->second;
}

std::vector<double> KeptMomentum::mean() {
  std::vector<double> all;
  for (int c = 0; c < velocity_->components(); ++c)
    all.push_back(state_.backend.has_host_code() ? exact_sum(c) : sum_of_parts(c));
  state_.ranks.add(all);
  for (double& sum : all) sum /= state_.scene.particle_count;
  return all;
}

double KeptMomentum::exact_sum(int component) const {
  const FieldReader value = velocity_->reader();
  const auto [sum] =
      exec::exact_sums<1>(state_.particles.count(), [&](Index i, double(&term)[1]) { term[0] = value(component, i); });
  return sum;
}

// On a device, so that the field need not come to the host.
double KeptMomentum::sum_of_parts(int component) {
  const auto& loops = state_.backend.fields<double>();
  parts_.resize_for_overwrite(static_cast<std::size_t>(loops.parts));
  const FieldView<const double> value = std::as_const(*velocity_).master(exec::Side::device);
  loops.partial_sums(value.base + component * value.stride, state_.particles.count(),
                     parts_.device(exec::Access::write));
  exec::ExactSum sum;
  sum.add(parts_.host());
  return sum.value();
}

template <class Real>
void KeptMomentum::add(const std::vector<double>& change) {
  constexpr auto device = exec::Side::device;
  constexpr auto read_write = exec::Access::read_write;
  exec::AddArguments<Real> all{};
  all.exact = velocity_->master(device, read_write);
  all.rounded = velocity_->view<Real>(device, read_write);
  all.components = velocity_->components();
  std::ranges::copy(change, all.by);
  state_.backend.fields<Real>().add(all, state_.particles.count());
}

}  // namespace mesogen
