#include "plugin/named_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plugin/plugin_call.hpp"

namespace mesogen {

namespace {

template <class Action>
auto told(const std::string& plugin, const char* call, ExitCode code, Action&& action) -> decltype(action()) {
  return call_plugin(PluginCall{.plugin = plugin, .call = call}, code, std::forward<Action>(action));
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::plugin_refused, what); }

std::string point(const std::array<double, 3>& at, const std::string& unit) {
  return fmt::format("({:g}, {:g}, {:g}) {}", at[0], at[1], at[2], unit);
}

bool is_finite(const std::array<double, 3>& at) {
  return std::ranges::all_of(at, [](double x) { return std::isfinite(x); });
}

void check(const Copies& copies, Index count, const std::string& unit) {
  if (copies.source.size() != copies.offset.size())
    refuse(fmt::format("gives {} sources, but {} offsets: each copy needs one of both", copies.source.size(),
                       copies.offset.size()));
  for (std::size_t n = 0; n < copies.source.size(); ++n) {
    if (copies.source[n] < 0 || copies.source[n] >= count)
      refuse(fmt::format("copy {} is of particle {}, which there is not", n, copies.source[n]));
    if (!is_finite(copies.offset[n]))
      refuse(fmt::format("the offset of copy {} is {}", n, point(copies.offset[n], unit)));
  }
}

/// Inside, faces included, along the axes that the scene has.
bool is_inside(const Scene& scene, const std::array<double, 3>& at) {
  for (unsigned d = 0; d < static_cast<unsigned>(scene.dimension); ++d)
    if (!(at[d] >= 0.0 && at[d] <= scene.box[d])) return false;
  return true;
}

void check(const Scene& scene, const Dummies& dummies, const std::string& unit) {
  if (dummies.position.size() != dummies.mirror.size())
    refuse(fmt::format("gives {} dummies, but {} mirror points: each dummy needs one", dummies.position.size(),
                       dummies.mirror.size()));
  for (std::size_t n = 0; n < dummies.position.size(); ++n) {
    if (!is_finite(dummies.position[n])) refuse(fmt::format("dummy {} is at {}", n, point(dummies.position[n], unit)));
    if (is_inside(scene, dummies.position[n]))
      refuse(fmt::format("dummy {} at {} lies inside the box: dummies belong beyond a face that does not wrap", n,
                         point(dummies.position[n], unit)));
    if (!is_inside(scene, dummies.mirror[n]))
      refuse(
          fmt::format("the mirror point of dummy {}, {}, lies outside the box: there are no particles to take values "
                      "from",
                      n, point(dummies.mirror[n], unit)));
  }
}

void check(std::string_view field, const std::vector<Extension>& extension, std::size_t expected) {
  if (extension.size() != expected)
    refuse(fmt::format("leaves {} rules for '{}' where there were {}: change them in place", extension.size(), field,
                       expected));
  for (const Extension& rule : extension)
    if (!std::isfinite(rule.factor) || !std::isfinite(rule.summand))
      refuse(fmt::format("a rule for '{}' is not finite: {} f + {}", field, rule.factor, rule.summand));
}

}  // namespace

void NamedBoundary::scales(Scales& scales) const {
  told(name_, "scales()", ExitCode::plugin_refused, [&] { plugin_->scales(scales); });
}
void NamedBoundary::prepare(const Scene& scene) {
  told(name_, "prepare()", ExitCode::plugin_refused, [&] { plugin_->prepare(scene); });
}
void NamedBoundary::parameters(ParameterList& list) {
  told(name_, "parameters()", ExitCode::plugin_refused, [&] { plugin_->parameters(list); });
}
bool NamedBoundary::periodic(int axis) const {
  return told(name_, "periodic()", ExitCode::plugin_refused, [&] { return plugin_->periodic(axis); });
}
bool NamedBoundary::wraps(int axis) const {
  return told(name_, "wraps()", ExitCode::plugin_refused, [&] { return plugin_->wraps(axis); });
}
void NamedBoundary::keep_inside(const Scene& scene, double* position, std::int32_t* images) const {
  told(name_, "keep_inside()", ExitCode::run_failed, [&] { plugin_->keep_inside(scene, position, images); });
}
void NamedBoundary::copies(const Scene& scene, const double* const* position, Index count, double reach,
                           Copies& out) const {
  told(name_, "copies()", ExitCode::run_failed, [&] {
    plugin_->copies(scene, position, count, reach, out);
    check(out, count, length_unit_);
  });
}
void NamedBoundary::carry_over(const Scene& scene, std::string_view field, int components, const Copies& copies,
                               std::vector<Extension>& extension) const {
  told(name_, "carry_over()", ExitCode::run_failed, [&] {
    plugin_->carry_over(scene, field, components, copies, extension);
    check(field, extension, copies.source.size() * static_cast<std::size_t>(components));
  });
}
void NamedBoundary::dummies(const Scene& scene, double reach, Dummies& out) const {
  told(name_, "dummies()", ExitCode::plugin_refused, [&] {
    plugin_->dummies(scene, reach, out);
    check(scene, out, length_unit_);
  });
}
void NamedBoundary::extend(const Scene& scene, std::string_view field, int components, const Dummies& dummies,
                           std::vector<Extension>& extension) const {
  told(name_, "extend()", ExitCode::run_failed, [&] {
    plugin_->extend(scene, field, components, dummies, extension);
    check(field, extension, dummies.position.size() * static_cast<std::size_t>(components));
  });
}

}  // namespace mesogen
