#include "simulation/world_view.hpp"

#include <limits>
#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

WorldView::~WorldView() = default;

std::vector<double> WorldView::values(std::string_view name, int component) const {
  const Field& field = world_.fields.at(name);
  if (component < 0 || component >= field.components())
    throw Error(ExitCode::plugin_refused, "'" + std::string(name) + "' has the components 0 to " +
                                              std::to_string(field.components() - 1) + ", not " +
                                              std::to_string(component));
  std::vector<double> all(world_.particles.id.size());
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < world_.particles.count(); ++i) all[static_cast<std::size_t>(i)] = field.value(component, i);
  return all;
}

std::vector<double> WorldView::position(int axis) const {
  std::vector<double> all(world_.particles.id.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::array<double, 3> at{};
    std::array<std::int32_t, 3> images{};
    for (int d = 0; d < world_.scene.dimension; ++d) at[d] = world_.particles.position[d][i];
    world_.boundary.keep_inside(world_.scene, at.data(), images.data());
    all[i] = at[axis];
  }
  return all;
}

std::vector<double> WorldView::unwrapped(int axis) const {
  std::vector<double> all(world_.particles.id.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = unwrapped_at(axis, i);
  return all;
}

double WorldView::unwrapped_at(int axis, std::size_t place) const {
  return world_.particles.position[axis][place] + world_.particles.images[axis][place] * world_.scene.box[axis];
}

double WorldView::constant(std::string_view name) const {
  const auto at = world_.scene.constants.find(name);
  return at == world_.scene.constants.end() ? std::numeric_limits<double>::quiet_NaN() : at->second;
}

}  // namespace mesogen
