#pragma once

#include <string>
#include <vector>

#include "diagnostics/trace.hpp"
#include "mesogen/plugin/passes.hpp"

namespace mesogen {

/// A plugin's pass as the scheduler sees it.
struct ScheduledPass {
  std::string owner;   ///< instance in the case: "physics.flow"
  std::string plugin;  ///< its type: "wcsph"
  Pass pass;
  bool on_device = false;          ///< its code runs on the backend's device, if that has one
  bool for_integration = false;    ///< needed to advance the run
  std::vector<bool> for_observer;  ///< needed by the n-th reader (observers, then output)
  Counter counter;                 ///< of what it took, by its title

  [[nodiscard]] bool pruned() const {
    if (for_integration) return false;
    for (const bool needed : for_observer)
      if (needed) return false;
    return true;
  }
  [[nodiscard]] std::string title() const { return owner + ": " + pass.name; }
};

}  // namespace mesogen
