#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "run/setup.hpp"

namespace mesogen {

/// How much memory a run will have resident at most, and for what.
struct MESOGEN_EXPORT MemoryForecast {
  struct Item {
    std::string what;
    double bytes = 0.0;
  };
  std::vector<Item> lasting;       ///< as long as the run lasts
  std::vector<Item> now_and_then;  ///< one at a time, but for the end of a run: a checkpoint, a frame

  /// All that lasts and the largest of the rest, bytes.
  [[nodiscard]] double peak() const;
};

/// From the case alone: nothing of this size is allocated. `program`: what this program has resident before a case is
/// set up, bytes.
MESOGEN_EXPORT MemoryForecast forecast_memory(const Setup& setup, double program);

/// Bytes of a stored frame, and of a checkpoint.
MESOGEN_EXPORT double frame_bytes(const Setup& setup);
MESOGEN_EXPORT double checkpoint_bytes(const Setup& setup);

}  // namespace mesogen
