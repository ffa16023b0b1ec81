#pragma once

#include "case/problems.hpp"
#include "run/setup.hpp"

/// What a case that is put together cannot do, each told as a problem of the key that mends it.
namespace mesogen {

/// Particles that stay where they are carry no colour, and nobody can follow them. To be called once observers have
/// their plans.
void refuse_traces(const Setup& setup, Problems& problems);

/// Operators over too few neighbours. Only where the scene sums over neighbours; to be called once it has its graph.
void refuse_few_neighbours(const Setup& setup, Problems& problems);

}  // namespace mesogen
