#pragma once

#include "diagnostics/trace.hpp"
#include "exec/backend.hpp"

namespace mesogen {

/// How the pieces of work of a run are timed: one `Span` around each, and end_of_work() last in it.
struct WorkClock {
  const Backend& backend;
  Trace* trace = nullptr;  ///< of each time that work is done, if one is asked for; must outlive that
  bool waits = false;      ///< is a device waited for after each piece of work, so that its time is told?

  /// A device does its work later, unless it is waited for.
  void end_of_work() const {
    if (waits) backend.finish();
  }
};

}  // namespace mesogen
