#include "plugin/plugin_call.hpp"

#include <new>

#include "plugin/call_text.hpp"

namespace mesogen {

constinit thread_local const CallUnderWay* CallUnderWay::innermost = nullptr;

std::string call_text(const PluginCall& call) {
  std::string text;
  write_call(call, [&](std::string_view piece) { text += piece; });
  return text;
}

void rethrow_of_plugin(const PluginCall& call, ExitCode code) {
  const std::string where = call_text(call);
  try {
    throw;
  } catch (const BadParameter&) {
    throw;  // its key names the place
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

}  // namespace mesogen
