#include "plugin/plugin_call.hpp"

#include <fmt/format.h>

#include <new>

namespace mesogen {

void rethrow_of_plugin(const std::string& where, ExitCode code) {
  try {
    throw;
  } catch (const Error& error) {
    throw Error(error.code(), where + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw;  // no fault of the plugin's
  } catch (const std::exception& error) {
    throw Error(code, where + " failed: " + error.what());
  } catch (...) {
    throw Error(code, where + " failed: it threw something that is no std::exception");
  }
}

std::string call_text(std::string_view plugin, std::string_view call) {
  return fmt::format("plugin \"{}\", {}", plugin, call);
}

std::string call_text(std::string_view instance, std::string_view plugin, std::string_view call, std::int64_t step,
                      double time, const Units& units) {
  return fmt::format("{} (plugin \"{}\"), {} at step {}, t = {:.6g} {}", instance, plugin, call, step, time,
                     units.time);
}

}  // namespace mesogen
