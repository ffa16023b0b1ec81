#pragma once

#include "case/problems.hpp"
#include "output/checkpoint.hpp"
#include "run/setup.hpp"

/// What of its case cannot change at a branch, since the checkpoint has it: the particles and what they carry.
namespace mesogen {

/// Adds a problem for each change of the domain, the particles or the initial conditions. Neither case has problems of
/// its own.
MESOGEN_EXPORT void check_branched_case(const Case& before, const Case& after, Problems& problems);

/// Adds a problem for each thing that the branch's setup needs of the checkpoint and that is not there, or the other
/// way round: fields that are advanced, numbers that plugins keep, periodic faces, time.
MESOGEN_EXPORT void check_branched_setup(const Setup& before, const Setup& after, const Checkpoint& checkpoint,
                                         Problems& problems);

/// Do particles lie in the same cells, so that their order of storage still serves?
MESOGEN_EXPORT bool same_cells(const Setup& before, const Setup& after);

}  // namespace mesogen
