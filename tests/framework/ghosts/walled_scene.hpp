#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "schedule/state.hpp"

/// Fluid beside walls with fields of all kinds, on any backend.
namespace mesogen::test {

inline constexpr int across = 24;
inline constexpr double spacing = 1.0 / across;
inline constexpr double radius = 0.3;

inline double site(int n) { return (n + 0.5) * spacing; }

/// What a test places in a box of edge 1.
struct Sites {
  std::array<std::vector<double>, 2> fluid;
  std::vector<WallParticle> walls;
  bool channel = false;  ///< the box ends along y

  void add_fluid(double x, double y) {
    fluid[0].push_back(x);
    fluid[1].push_back(y);
  }
};

/// Disordered fluid between walls across y.
inline Sites channel() {
  Sites sites;
  sites.channel = true;
  std::mt19937_64 random(3);
  const auto moved = [&] { return 0.3 * spacing * (2.0 * std::generate_canonical<double, 53>(random) - 1.0); };
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) sites.add_fluid(site(column) + moved(), site(row) + moved());
  for (int layer = 0; layer < 5; ++layer)
    for (int column = 0; column < across; ++column) {
      const double depth = site(layer);
      sites.walls.push_back(
          {.position = {site(column), -depth, 0.0}, .mirror = {site(column), depth, 0.0}, .normal = {0.0, 1.0, 0.0}});
      sites.walls.push_back({.position = {site(column), 1.0 + depth, 0.0},
                             .mirror = {site(column), 1.0 - depth, 0.0},
                             .normal = {0.0, -1.0, 0.0},
                             .wall = 1});
    }
  return sites;
}

/// A disc in the middle: a pillar, or with `inside` a dish. Particles stay on their lattice.
inline Sites disc(bool inside) {
  Sites sites;
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column) {
      const double x = site(column) - 0.5;
      const double y = site(row) - 0.5;
      const double from_centre = std::hypot(x, y);
      if ((from_centre < radius) == inside) {
        sites.add_fluid(site(column), site(row));
        continue;
      }
      if (std::abs(from_centre - radius) > 4.5 * spacing) continue;
      const double to = (2.0 * radius - from_centre) / from_centre;
      const double sign = (inside ? -1.0 : 1.0) / from_centre;
      sites.walls.push_back({.position = {site(column), site(row), 0.0},
                             .mirror = {0.5 + to * x, 0.5 + to * y, 0.0},
                             .normal = {sign * x, sign * y, 0.0},
                             .curvature = (inside ? -1.0 : 1.0) / radius,
                             .wall = x > 0.0 ? 1 : 0});
    }
  return sites;
}

/// Fields are curved, held, reflected, or go on as they are, and wall 1 may have another rule than wall 0.
class Conditions final : public Boundary {
 public:
  Conditions(Continuation along_x, Continuation along_y, std::vector<WallParticle> walls)
      : continuation_{along_x, along_y}, walls_(std::move(walls)) {}
  [[nodiscard]] Continuation continuation(int axis) const override { return continuation_[axis == 0 ? 0 : 1]; }
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene&, double) const override { return walls_; }
  [[nodiscard]] AffineRule wall_rule(const Scene&, const FieldKind& field, const WallParticle& at) const override {
    const std::array value{0.25, -0.4, 0.1, 0.7};
    if (field.role == FieldRole::velocity) return AffineRule::curved_at(field, value);
    if (field.rank == Rank::scalar && at.wall == 1) return AffineRule::held_at(field, value);
    if (field.rank == Rank::scalar) return AffineRule::curved_at(field, value);
    if (field.rank == Rank::order_tensor) return AffineRule::held_at(field, value);
    if (field.rank == Rank::vector) return AffineRule::reflected(field, at.normal);
    return AffineRule(field);
  }

 private:
  std::array<Continuation, 2> continuation_;
  std::vector<WallParticle> walls_;
};

inline sph::SmoothingKernel quintic() {
  const sph::KernelShape shape{.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}}, .power = 5};
  const double h = 4.0 / 3.0 * spacing;
  return {shape, h, shape.normalisation(2) / (h * h)};
}

inline Scene scene_of(const Sites& sites, Precision precision) {
  Scene scene;
  scene.dimension = 2;
  scene.precision = precision;
  scene.box = {1.0, 1.0, 0.0};
  scene.spacing = spacing;
  scene.smoothing_length = quintic().smoothing_length;
  scene.support = quintic().radius();
  scene.particle_count = static_cast<Index>(sites.fluid[0].size());
  return scene;
}

inline Particles particles_at(const Sites& sites, exec::DeviceMemory* memory) {
  Particles particles(memory);
  particles.dimension = 2;
  particles.id.resize_for_overwrite(sites.fluid[0].size());
  const auto id = particles.id.host(exec::Access::write);
  std::iota(id.begin(), id.end(), 0);
  for (std::size_t d = 0; d < 2; ++d) {
    particles.position[d].assign(sites.fluid[d]);
    particles.images[d].resize(sites.fluid[d].size());
  }
  return particles;
}

struct Kind {
  std::optional<FieldKind> kind;
  int components;
};

inline const std::map<std::string, Kind> kinds = {
    {"scalar", {FieldKind{Rank::scalar, FieldRole::state, 2}, 1}},
    {"velocity", {FieldKind{Rank::vector, FieldRole::velocity, 2}, 2}},
    {"force", {FieldKind{Rank::vector, FieldRole::derived, 2}, 2}},
    {"order tensor", {FieldKind{Rank::order_tensor, FieldRole::state, 2}, 2}},
    {"stress", {FieldKind{Rank::matrix, FieldRole::derived, 2}, 4}},
    {"anything", {std::nullopt, 6}},
};

inline double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Its fields have values, and particles are sorted.
class Walled {
 public:
  Walled(const Sites& sites, Continuation along, Precision precision, const Backend& backend)
      : boundary_(along, sites.channel ? Continuation::none : along, sites.walls),
        state_(scene_of(sites, precision), quintic(), boundary_, particles_at(sites, backend.memory()), backend) {
    for (const auto& [name, kind] : kinds) state_.add_field(name, kind.components, false).kind = kind.kind;
    state_.order.settle();
    set_fields();
  }

  /// Moves all particles by up to `farthest` (m) along each axis.
  void move(double farthest) {
    const auto id = state_.particles.id.host();
    for (std::size_t d = 0; d < 2; ++d) {
      const auto position = state_.particles.position[d].host(exec::Access::read_write);
      for (std::size_t i = 0; i < id.size(); ++i)
        position[i] += farthest * std::sin(1.0 + static_cast<double>(id[i]) + 2.0 * static_cast<double>(d));
    }
    state_.order.mark_moved();
    state_.order.settle();
    set_fields();
  }

  void refresh() {
    for (const auto& [name, kind] : kinds) state_.boundary_values.refresh(state_.fields.at(name));
  }

  /// By component and wall particle.
  [[nodiscard]] std::vector<double> at_walls(const std::string& name) {
    Field& field = state_.fields.at(name);
    state_.boundary_values.refresh(field);
    std::vector<double> values;
    const Index first = state_.particles.count();
    for (int c = 0; c < field.components(); ++c)
      for (Index n = 0; n < state_.neighbourhood.walls().count(); ++n) values.push_back(field.value(c, first + n));
    return values;
  }

  /// As if all had changed where they are.
  void touch() {
    for (const auto& [name, kind] : kinds) ++state_.fields.at(name).version;
    state_.order.mark_moved();
  }

  [[nodiscard]] State& state() { return state_; }

 private:
  void set_fields() {
    for (const auto& [name, kind] : kinds) {
      Field& field = state_.fields.at(name);
      for (Index i = 0; i < state_.particles.count(); ++i) {
        const double x = state_.particles.position[0].host()[static_cast<std::size_t>(i)];
        const double y = state_.particles.position[1].host()[static_cast<std::size_t>(i)];
        for (int c = 0; c < kind.components; ++c)
          field.set(c, i, std::sin(2.0 * std::numbers::pi * x + c) * std::cos((3.0 + c) * y));
      }
      ++field.version;
    }
  }

  Conditions boundary_;
  State state_;
};

}  // namespace mesogen::test
