#pragma once

#include <memory>

#include "run/setup.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// The state that a setup starts from: its particles, with the fields that its plugins need, as the initial conditions
/// set them.
std::unique_ptr<State> state_at_start(const Setup& setup);

}  // namespace mesogen
