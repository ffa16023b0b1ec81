#include "run/watches.hpp"

#include "plugin/plugin_call.hpp"

namespace mesogen {

Watches::Watches(const Setup& setup, const State& state, const Integrator& integrator)
    : state_(state), integrator_(integrator) {
  if (setup.source.time.step) return;
  for (const auto& member : setup.physics)
    for (const FieldDeclaration& field : member.passes.fields())
      if (field.watch && has_rate(field.advance)) watched_.push_back({field.name, &member, field.watch});
}

std::vector<std::string> Watches::look() const {
  std::vector<std::string> changes;
  for (const Watched& one : watched_) {
    const PluginCall call{.plugin = one.owner->type,
                          .call = "watch of",
                          .subject = one.field,
                          .instance = one.owner->instance,
                          .step = &state_.step,
                          .time = &state_.time,
                          .time_unit = state_.units.time};
    const std::string change = call_plugin(
        call, ExitCode::run_failed, [&] { return one.function(integrator_.largest(one.field), state_.step_size); });
    if (!change.empty()) changes.push_back(one.owner->instance + ": " + change);
  }
  return changes;
}

}  // namespace mesogen
