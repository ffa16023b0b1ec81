#pragma once

#include <map>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "output/checkpoint.hpp"
#include "run/setup.hpp"
#include "schedule/state.hpp"

/// The state of a run in a checkpoint: particles, the order in which they are stored, the fields that last from step to
/// step, and the numbers that plugins keep.
namespace mesogen {

void save_state(const Setup& setup, State& state, Checkpoint& checkpoint);

/// Throws Error(bad_case) if the checkpoint belongs to another case.
void restore_state(const Setup& setup, const Checkpoint& checkpoint, State& state);

/// The list of this name in a checkpoint. Throws Error(bad_case) if there is none of this size; `of` says what it
/// counts: "particles".
template <class List>
const List& stored(const std::map<std::string, List>& lists, const std::string& name, std::size_t size,
                   const std::string& of) {
  const auto at = lists.find(name);
  if (at == lists.end() || at->second.size() != size)
    throw Error(ExitCode::bad_case, "the checkpoint has no '" + name + "' for " + std::to_string(size) + " " + of +
                                        ": it belongs to another case");
  return at->second;
}

}  // namespace mesogen
