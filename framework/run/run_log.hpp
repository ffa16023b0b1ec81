#pragma once

#include <cstdint>
#include <vector>

#include "diagnostics/log.hpp"
#include "diagnostics/trace.hpp"
#include "run/setup.hpp"
#include "run/stepper.hpp"

/// What a run says of itself in its log.
namespace mesogen {

/// How a new run begins.
void log_beginning(Log& log, const Setup& setup, const Stepper::Step& first);
/// Where it computes, and what of it computes elsewhere.
void log_device(Log& log, const Setup& setup);
/// What plugins changed of themselves after the last step.
void log_changes(Log& log, const Setup& setup, Stepper& stepper);
/// How fast it was.
void log_speed(Log& log, const Setup& setup, std::int64_t steps, double seconds, std::int64_t sortings);
/// Where the time of its steps went, the most first. What was done `before` the first step belongs to no step.
void log_shares(Log& log, std::vector<Counter> all, const std::vector<Counter>& before, std::int64_t steps,
                double seconds);

}  // namespace mesogen
