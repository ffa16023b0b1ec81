#pragma once

#include <optional>
#include <string>

#include "mesogen/export.hpp"
#include "run/setup.hpp"

/// What frames and checkpoints of a run take of a disk.
namespace mesogen {

/// All that lies there at the end, bytes.
MESOGEN_EXPORT double bytes_on_disk(const Setup& setup);

/// The most that lies there at a time, bytes: frames twice, while they are packed at the end.
MESOGEN_EXPORT double most_on_disk(const Setup& setup);

/// A disk that is too small.
struct Excess {
  std::string key;   ///< of the case, that asks for the most
  std::string text;  ///< what a run takes, and what fits
};
/// Nothing if the run fits a disk with so many bytes free, or 0 are known.
MESOGEN_EXPORT std::optional<Excess> beyond_disk(const Setup& setup, double free);

}  // namespace mesogen
