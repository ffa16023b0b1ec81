#include "plugin/named_boundary.hpp"

#include "plugin/plugin_call.hpp"

namespace mesogen {

namespace {

template <class Action>
auto told(const std::string& plugin, const char* call, ExitCode code, Action&& action) -> decltype(action()) {
  try {
    return action();
  } catch (...) {
    rethrow_of_plugin(call_text(plugin, call), code);
  }
}

}  // namespace

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
  told(name_, "copies()", ExitCode::run_failed, [&] { plugin_->copies(scene, position, count, reach, out); });
}
void NamedBoundary::refresh(const Copies& copies, FieldView<float> field, int components, Index count) const {
  told(name_, "refresh()", ExitCode::run_failed, [&] { plugin_->refresh(copies, field, components, count); });
}
void NamedBoundary::refresh(const Copies& copies, FieldView<double> field, int components, Index count) const {
  told(name_, "refresh()", ExitCode::run_failed, [&] { plugin_->refresh(copies, field, components, count); });
}
void NamedBoundary::dummies(const Scene& scene, double reach, Dummies& out) const {
  told(name_, "dummies()", ExitCode::plugin_refused, [&] { plugin_->dummies(scene, reach, out); });
}
void NamedBoundary::extend(const Scene& scene, std::string_view field, int components, const Dummies& dummies,
                           std::vector<Extension>& extension) const {
  told(name_, "extend()", ExitCode::run_failed, [&] { plugin_->extend(scene, field, components, dummies, extension); });
}

}  // namespace mesogen
