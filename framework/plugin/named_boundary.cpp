#include "plugin/named_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plugin/plugin_call.hpp"
#include "plugin/way_to_mirror.hpp"

namespace mesogen {

namespace {

template <class Action>
auto told(const std::string& plugin, const char* call, ExitCode code, Action&& action) -> decltype(action()) {
  return call_plugin(PluginCall{.plugin = plugin, .call = call}, code, std::forward<Action>(action));
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::plugin_refused, what); }

std::string text(const std::array<double, 3>& at) { return fmt::format("({:g}, {:g}, {:g})", at[0], at[1], at[2]); }

bool is_finite(const std::array<double, 3>& at) {
  return std::ranges::all_of(at, [](double x) { return std::isfinite(x); });
}

void check(const AffineRule& rule, const FieldKind& field) {
  const int components = field.components();
  if (rule.components() != components)
    refuse(
        fmt::format("the rule for a field of rank {} has {} components instead of {}: make it with AffineRule(field)",
                    to_string(field.rank), rule.components(), components));
  for (int r = 0; r < components; ++r) {
    bool finite = std::isfinite(rule.summand(r));
    for (int c = 0; c < components; ++c) finite = finite && std::isfinite(rule.matrix(r, c));
    if (!finite)
      refuse(fmt::format("component {} of the rule for a field of rank {} is not finite", r, to_string(field.rank)));
  }
}

}  // namespace

void NamedBoundary::check(const Scene& scene, const WallParticle& particle, std::size_t number) const {
  if (!is_finite(particle.position))
    refuse(fmt::format("wall particle {} is at {} {}", number, text(particle.position), length_unit_));
  for (unsigned d = 0; d < static_cast<unsigned>(scene.dimension); ++d) {
    // Written so that what is not a number is refused.
    if (!(particle.mirror[d] >= 0.0 && particle.mirror[d] <= scene.box[d]))
      refuse(fmt::format(
          "the mirror point of wall particle {}, {} {}, lies outside the box: there is no fluid to take values from",
          number, text(particle.mirror), length_unit_));
    if (plugin_->periodic(static_cast<int>(d)) && !(particle.position[d] >= 0.0 && particle.position[d] < scene.box[d]))
      refuse(
          fmt::format("wall particle {} at {} {} lies outside the box along {}, where the box is periodic: give the "
                      "one inside, its images are made from it",
                      number, text(particle.position), length_unit_, "xyz"[d]));
  }
  const auto& n = particle.normal;
  if (!(std::abs(std::hypot(n[0], n[1], n[2]) - 1.0) < 1e-6))
    refuse(fmt::format("the normal of wall particle {}, {}, is no unit vector", number, text(n)));
  const std::array<double, 3> way = way_to_mirror(scene, *plugin_, particle);
  const double length = std::hypot(way[0], way[1], way[2]);
  const double along = way[0] * n[0] + way[1] * n[1] + way[2] * n[2];
  // In a corner the two may differ. A particle on the surface is its own mirror point.
  if (!(along > 0.5 * length) && length > 1e-9 * scene.spacing)
    refuse(fmt::format("the normal of wall particle {}, {}, does not point from the particle to its mirror point",
                       number, text(n)));
}

void NamedBoundary::scales(Scales& scales) const {
  told(name_, "scales()", ExitCode::plugin_refused, [&] { plugin_->scales(scales); });
}
void NamedBoundary::prepare(const Scene& scene) {
  told(name_, "prepare()", ExitCode::plugin_refused, [&] { plugin_->prepare(scene); });
}
void NamedBoundary::parameters(ParameterList& list) {
  told(name_, "parameters()", ExitCode::plugin_refused, [&] { plugin_->parameters(list); });
}
Continuation NamedBoundary::continuation(int axis) const {
  return told(name_, "continuation()", ExitCode::plugin_refused, [&] { return plugin_->continuation(axis); });
}
std::array<double, 3> NamedBoundary::shear(const Scene& scene, const std::array<int, 3>& boxes) const {
  return told(name_, "shear()", ExitCode::plugin_refused, [&] {
    const std::array<double, 3> by = plugin_->shear(scene, boxes);
    if (!is_finite(by)) refuse(fmt::format("moves an image of the box by {} {}", text(by), length_unit_));
    for (unsigned d = 0; d < 3; ++d)
      if (by[d] != 0.0 && (static_cast<int>(d) >= scene.dimension || !plugin_->periodic(static_cast<int>(d))))
        refuse(fmt::format("moves an image of the box along {}, where the box is not periodic", "xyz"[d]));
    return by;
  });
}
bool NamedBoundary::strays(const double* position) const {
  return told(name_, "strays()", ExitCode::run_failed, [&] { return plugin_->strays(position); });
}
void NamedBoundary::keep_inside(const Scene& scene, double* position, std::int32_t* images) const {
  told(name_, "keep_inside()", ExitCode::run_failed, [&] { plugin_->keep_inside(scene, position, images); });
}
std::vector<WallParticle> NamedBoundary::wall_particles(const Scene& scene, double reach) const {
  return told(name_, "wall_particles()", ExitCode::plugin_refused, [&] {
    std::vector<WallParticle> all = plugin_->wall_particles(scene, reach);
    for (std::size_t n = 0; n < all.size(); ++n) check(scene, all[n], n);
    return all;
  });
}
AffineRule NamedBoundary::ghost_rule(const Scene& scene, const FieldKind& field,
                                     const std::array<int, 3>& boxes) const {
  return told(name_, "ghost_rule()", ExitCode::run_failed, [&] {
    const AffineRule rule = plugin_->ghost_rule(scene, field, boxes);
    mesogen::check(rule, field);
    return rule;
  });
}
AffineRule NamedBoundary::wall_rule(const Scene& scene, const FieldKind& field, const WallParticle& at) const {
  return told(name_, "wall_rule()", ExitCode::run_failed, [&] {
    const AffineRule rule = plugin_->wall_rule(scene, field, at);
    mesogen::check(rule, field);
    return rule;
  });
}

}  // namespace mesogen
