#pragma once

#include <cstddef>
#include <vector>

#include "exec/snapshot.hpp"
#include "output/frame.hpp"
#include "run/setup.hpp"
#include "run/whole_state.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// What a frame holds, as it was when the frame was taken: in the order of storage, so that taking it is a copy and
/// nothing more. Another thread may put it in the order of ids while steps go on.
class FrameValues {
 public:
  /// All of these must outlive it.
  FrameValues(const State& state, const WholeState& whole, const Setup& setup);

  /// Copies what is now, in place of what was taken before. The output fields are up to date.
  void take();
  /// What was taken, without values.
  [[nodiscard]] std::vector<FrameField> fields() const;
  /// Gives these fields their values. Looks at nothing that steps change.
  void fill(std::vector<FrameField>& fields) const;

 private:
  using Columns = std::vector<const std::byte*>;
  void fill_positions(const Columns& columns, FrameField& position, FrameField& image) const;

  const State& state_;
  const WholeState& whole_;
  const Setup& setup_;
  exec::Snapshot snapshot_;    // of ids, positions, images, and the output fields, component by component
  std::size_t count_ = 0;      // particles
  std::vector<bool> doubles_;  // of each output field: others are in single precision
};

}  // namespace mesogen
