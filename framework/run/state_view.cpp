#include "run/state_view.hpp"

#include <limits>
#include <string>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/for_each.hpp"
#include "neighbours/outside.hpp"
#include "particles/storage_loops.hpp"

namespace mesogen {

StateView::~StateView() = default;

std::vector<double> StateView::values(std::string_view name, int component) const {
  const Field& field = fields_.at(name);
  if (component < 0 || component >= field.components())
    throw Error(ExitCode::plugin_refused, "'" + std::string(name) + "' has the components 0 to " +
                                              std::to_string(field.components() - 1) + ", not " +
                                              std::to_string(component));
  std::vector<double> all(particles_.id.size());
  const FieldReader value = field.reader();
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < particles_.count(); ++i) all[static_cast<std::size_t>(i)] = value(component, i);
  return all;
}

std::vector<double> StateView::position(int axis) const {
  std::vector<double> all(particles_.id.size());
  const auto position = exec::pointers(particles_.position, exec::Side::host);
  const Scene& scene = state_.scene;
  const auto count = particles_.count();
  Index outside = 0;  // how many have left the box since the last sorting
#pragma omp parallel for schedule(static) reduction(+ : outside)
  for (Index i = 0; i < count; ++i)
    outside += exec::is_inside(position.data(), scene.box.data(), scene.dimension, i) ? 0 : 1;
  const double* const wanted = position[axis];
#pragma omp parallel for simd schedule(static)
  for (Index i = 0; i < count; ++i) all[static_cast<std::size_t>(i)] = wanted[i];
  for (Index i = 0; i < count && outside > 0; ++i) {
    if (exec::is_inside(position.data(), scene.box.data(), scene.dimension, i)) continue;
    --outside;
    std::array<double, 3> at{};
    std::array<std::int32_t, 3> images{};
    for (int d = 0; d < scene.dimension; ++d) at[d] = position[d][i];
    state_.boundary.keep_inside(scene, at.data(), images.data());
    all[static_cast<std::size_t>(i)] = at[axis];
  }
  return all;
}

std::vector<double> StateView::unwrapped(int axis) const {
  std::vector<double> all(particles_.id.size());
  const auto position = particles_.position[axis].host();
  const auto images = particles_.images[axis].host();
  const double length = state_.scene.box[axis];
  exec::for_each(exec::Space{}, particles_.count(), [=, to = all.data()](Index i) {
    const auto at = static_cast<std::size_t>(i);
    to[i] = position[at] + images[at] * length;
  });
  return all;
}

std::vector<double> StateView::unwrapped_at(int axis, std::span<const Index> places) const {
  constexpr auto device = exec::Side::device;
  State::Chosen& chosen = state_.chosen;
  chosen.place.assign(places);
  chosen.value.resize_for_overwrite(places.size());
  backend_.storage().gather_unwrapped(
      {particles_.position[axis].on(device), particles_.images[axis].on(device), state_.scene.box[axis]},
      std::as_const(chosen.place).on(device), static_cast<Index>(places.size()),
      chosen.value.device(exec::Access::write));
  const auto values = std::as_const(chosen.value).host();
  return {values.begin(), values.end()};
}

double StateView::constant(std::string_view name) const {
  const auto at = state_.scene.constants.find(name);
  return at == state_.scene.constants.end() ? std::numeric_limits<double>::quiet_NaN() : at->second;
}

}  // namespace mesogen
