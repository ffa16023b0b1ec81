#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "case/units.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// Throws on what a plugin threw, as an Error that begins with `where`. An Error keeps its exit code, for it is meant
/// for the user; anything else gets `code`. To be called in catch (...).
[[noreturn]] MESOGEN_EXPORT void rethrow_of_plugin(const std::string& where, ExitCode code);

/// A call while a case is put together; the problem that comes of it names the instance: `plugin "wcsph", passes()`.
MESOGEN_EXPORT std::string call_text(std::string_view plugin, std::string_view call);

/// A call while the case runs: `physics.flow (plugin "wcsph"), pass "continuity" at step 3, t = 0.02 s`.
MESOGEN_EXPORT std::string call_text(std::string_view instance, std::string_view plugin, std::string_view call,
                                     std::int64_t step, double time, const Units& units);

/// Runs one call into a plugin while a case is put together. Whatever it throws comes out as an Error that names the
/// plugin and the call.
template <class Action>
auto call_plugin(std::string_view plugin, std::string_view call, Action&& action) -> decltype(action()) {
  try {
    return std::forward<Action>(action)();
  } catch (...) {
    rethrow_of_plugin(call_text(plugin, call), ExitCode::plugin_refused);
  }
}

}  // namespace mesogen
