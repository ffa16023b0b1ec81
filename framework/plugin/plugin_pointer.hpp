#pragma once

#include <memory>

#include "plugin/plugin_call.hpp"

namespace mesogen {

/// Deletes an object that a plugin made. Its destructor is a call into the plugin too.
struct DeletePlugin {
  std::string_view plugin;  ///< its name, as its descriptor has it

  template <class Base>
  void operator()(Base* object) const {
    const PluginCall call{.plugin = plugin, .call = "destructor"};
    const CallUnderWay under_way(call);
    delete object;
  }
};

template <class Base>
using PluginPointer = std::unique_ptr<Base, DeletePlugin>;

}  // namespace mesogen
