#include "run/whole_state.hpp"

#include <memory>

#include "ranks/ranks.hpp"

namespace mesogen {

void WholeState::gather(const std::vector<std::string>& fields) {
  if (!gathers()) return;
  if (order_ != state_.order.version()) gather_particles();
  for (const std::string& name : fields)
    if (const Field* const field = state_.fields.find(name)) gather(*field);
}

void WholeState::gather_particles() {
  const auto bring = [&](const auto& own, auto& all) { all.assign(mesogen::gather(state_.ranks, own.host())); };
  particles_.dimension = state_.particles.dimension;
  bring(state_.particles.id, particles_.id);
  for (int d = 0; d < particles_.dimension; ++d) {
    bring(state_.particles.position[d], particles_.position[d]);
    bring(state_.particles.images[d], particles_.images[d]);
  }
  order_ = state_.order.version();
}

// Only what a reader sees of it.
void WholeState::gather(const Field& field) {
  Gathered& last = gathered_[field.name()];
  if (last.field == field.version && last.order == order_) return;
  constexpr auto host = exec::Side::host;
  Field* whole = fields_.find(field.name());
  if (whole == nullptr)
    whole = &fields_.add(std::make_unique<Field>(
        field.name(), field.components(), field.is_double() ? Precision::double_precision : Precision::single_precision,
        field.integrated()));
  whole->resize(particles_.count(), 0);
  const auto count = static_cast<std::size_t>(state_.particles.count());
  const auto bring = [&](const auto& own, const auto& all) {
    for (int c = 0; c < field.components(); ++c)
      std::ranges::copy(mesogen::gather(state_.ranks, std::span(own.component(c), count)), all.component(c));
  };
  if (field.reads_doubles()) {
    bring(field.master(host), whole->master(host, exec::Access::read_write));
  } else {
    bring(field.view<float>(host), whole->view<float>(host, exec::Access::read_write));
  }
  last = {field.version, order_};
}

}  // namespace mesogen
