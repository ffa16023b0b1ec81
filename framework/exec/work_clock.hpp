#pragma once

#include "diagnostics/trace.hpp"
#include "exec/backend.hpp"

namespace mesogen {

/// How the pieces of work of a run are timed: one `Span` around each, and end_of_work() last in it.
struct WorkClock {
  const Backend& backend;
  Trace* trace = nullptr;  ///< records each piece of work; null: nobody asked for a trace
  bool waits = false;      ///< wait for the device after each piece of work, so that its time is measured

  /// A device does its work later: without this wait a span would measure nothing.
  void end_of_work() const {
    if (waits) backend.finish();
  }
};

}  // namespace mesogen
