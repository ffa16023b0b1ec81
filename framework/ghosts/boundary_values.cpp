#include "ghosts/boundary_values.hpp"

#include <algorithm>
#include <vector>

#include "ghosts/ghost_loops.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "sph/mirror_loops.hpp"

namespace mesogen {

// Where particles moved, other ones stand before the wall; a ghost's values are its source's wherever that is.
std::uint64_t BoundaryValues::positions() const {
  return neighbourhood_.walls().anywhere() ? neighbourhood_.version() : 0;
}

bool BoundaryValues::up_to_date(const Field& field) const {
  if (neighbourhood_.boundary_count() == 0 && !ranks_.several()) return true;
  return field.refreshed == field.version && field.refreshed_at == positions();
}

void BoundaryValues::refresh(Field& field) {
  if (up_to_date(field)) return;
  if (walls_version_ != neighbourhood_.walls_version()) rules_.clear();
  walls_version_ = neighbourhood_.walls_version();
  const Span span(refreshing_, clock_.trace);
  dispatch(scene_.precision, [&]<class Real>() { refresh_ghosts<Real>(field); });
  if (neighbourhood_.walls().count() > 0) {
    dispatch(scene_.precision, scene_.dimension, [&]<class Real, int Dim>() { refresh_walls<Real, Dim>(field); });
  }
  field.refreshed = field.version;
  field.refreshed_at = positions();
  clock_.end_of_work();
}

const BoundaryValues::Rules& BoundaryValues::rules_of(const Field& field) {
  const auto at = rules_.find(field.name());
  if (at != rules_.end()) return at->second;
  const Rules same(clock_.backend.memory());
  return rules_.emplace(field.name(), field.kind ? ask(*field.kind, field.difference) : same).first->second;
}

BoundaryValues::Rules BoundaryValues::ask(const FieldKind& field, bool difference) const {
  const auto asked = [difference](const AffineRule& rule) { return difference ? rule.of_differences() : rule; };
  const Images& images = neighbourhood_.ghosts().images();
  std::vector<AffineRule> ghosts;
  ghosts.reserve(static_cast<std::size_t>(images.count));
  for (int image = 0; image < images.count; ++image)
    ghosts.push_back(asked(boundary_.ghost_rule(scene_, field, boxes_of(images, image))));
  if (ranks_.several()) ghosts.emplace_back(field);  // of those of other ranks where they are
  std::vector<AffineRule> walls;
  std::vector<std::uint8_t> curved;
  std::vector<double> at_wall;
  for (const WallSet::Member& wall : neighbourhood_.walls().members()) {
    const AffineRule own = asked(boundary_.wall_rule(scene_, field, wall.particle));
    walls.push_back(wall.image == WallSet::no_image ? own : ghosts[static_cast<std::size_t>(wall.image)].after(own));
    curved.push_back(own.curved() ? 1 : 0);
    for (int c = 0; c < own.components(); ++c) at_wall.push_back(own.at_wall(c));
  }
  exec::DeviceMemory* const memory = clock_.backend.memory();
  Rules rules(memory);
  rules.ghosts = RuleTable(ghosts, memory);
  rules.walls = RuleTable(walls, memory);
  rules.vector = field.rank == Rank::vector;
  if (std::ranges::find(curved, 1) != curved.end()) {
    rules.straight_somewhere = std::ranges::find(curved, 0) != curved.end();
    rules.curved.assign(curved);
    rules.at_wall.assign(at_wall);
  }
  return rules;
}

template <class Real>
void BoundaryValues::refresh_ghosts(Field& field) {
  constexpr auto device = exec::Side::device;
  const GhostView ghosts = neighbourhood_.ghost_view(device);
  const FieldView<Real> values = field.view<Real>(device, exec::Access::read_write);
  if (ranks_.several()) neighbourhood_.halo().bring(values, field.components(), ghosts.first + ghosts.count);
  if (ghosts.count == 0) return;
  clock_.backend.ghosts().refresh(ghosts, rules_of(field).ghosts.view(device), values, field.components());
}

template <class Real, int Dim>
const double* BoundaryValues::find(sph::MirrorFit fit, Weights& weights) {
  const Mirrors& mirrors = neighbourhood_.mirrors();
  if (weights.version != neighbourhood_.version()) {
    const sph::MirrorPoints<Dim> points = mirrors.points<Dim>();
    Neighbours<Real, Dim> neighbours{};
    neighbourhood_.fill(neighbours, mirrors.side());
    weights.values.resize_for_overwrite(mirrors.weights<Real>());
    double* const values = weights.values.on(mirrors.side(), exec::Access::write);
    if (clock_.backend.has_host_code()) {
      sph::find_mirror_weights<Real, Dim>(fit, neighbours, points, kernel_, values);
    } else {
      clock_.backend.mirrors<Real>().find_weights(fit, neighbours, points, kernel_, values);
    }
    weights.version = neighbourhood_.version();
  }
  return weights.values.on(mirrors.side());
}

template <class Real, int Dim>
void BoundaryValues::refresh_walls(Field& field) {
  const exec::Side side = neighbourhood_.mirrors().side();
  const Rules& rules = rules_of(field);
  const bool any_curved = !rules.curved.empty();
  const bool any_linear = rules.vector || rules.straight_somewhere;
  const sph::MirrorWeights weights{any_linear ? find<Real, Dim>(sph::MirrorFit::linear, linear_) : nullptr,
                                   any_curved ? find<Real, Dim>(sph::MirrorFit::curved, curved_) : nullptr};
  const sph::CurvedValues curved{rules.vector, any_curved ? rules.curved.on(side) : nullptr, rules.at_wall.on(side)};
  const sph::MirrorPoints<Dim> points = neighbourhood_.mirrors().points<Dim>();
  const RuleView walls = rules.walls.view(side);
  const FieldView<Real> values = field.view<Real>(side, exec::Access::read_write);
  const Index first = neighbourhood_.wall_view(side).first;
  if (clock_.backend.has_host_code()) {
    sph::refresh_walls<Real, Dim>(points, weights, curved, walls, values, field.components(), first);
  } else {
    clock_.backend.mirrors<Real>().refresh(points, weights, curved, walls, values, field.components(), first);
  }
}

}  // namespace mesogen
