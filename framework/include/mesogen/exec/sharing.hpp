#pragma once

#include <cstdint>
#include <span>

#include "mesogen/export.hpp"

namespace mesogen::exec {

/// The processes that share the particles of a run add up what each found for its own. All of them call alike, and
/// each call waits for the others. Sums have the same bits on all processes and in every run.
class MESOGEN_EXPORT Sharing {
 public:
  Sharing() = default;
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;
  virtual ~Sharing();

  /// Each number becomes the sum of those that the processes have in its place.
  virtual void add(std::span<double> numbers) const = 0;
  virtual void add(std::span<float> numbers) const = 0;
  virtual void add(std::span<std::int64_t> numbers) const = 0;
};

}  // namespace mesogen::exec
