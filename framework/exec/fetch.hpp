#pragma once

#include <cstddef>

#include "mesogen/export.hpp"

namespace mesogen::exec {

/// Brings bytes of a device to the host while the device goes on with its work; one lot at a time.
class MESOGEN_EXPORT Fetch {
 public:
  Fetch() = default;
  Fetch(const Fetch&) = delete;
  Fetch& operator=(const Fetch&) = delete;
  /// Waits for what is on its way.
  virtual ~Fetch();

  /// Asks for bytes as they are once all is done that the device was asked for before. Until wait() has returned,
  /// nobody may change them on the device. Throws Error(run_failed).
  virtual void begin(const void* device, std::size_t bytes) = 0;
  /// Those bytes on the host, where they stay until the next begin(). Any thread may wait for them. Throws
  /// Error(run_failed) if something that the device was asked for failed.
  [[nodiscard]] virtual const void* wait() = 0;
};

}  // namespace mesogen::exec
