#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "exec/fetch.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"

namespace mesogen::exec {

/// Copies of values as they were at one moment, on the host, while host and device go on to change the values
/// themselves. What lies on a device is first copied there, in the order of all its work, and then fetched beside that
/// work. Where the device has no room for such copies, they go straight to the host, and the host waits for them.
class MESOGEN_EXPORT Snapshot {
 public:
  /// Bytes that lie on one side.
  struct Source {
    const void* place;
    std::size_t bytes;
    Side side;
  };

  /// `memory`: of the device; null where there is none.
  explicit Snapshot(DeviceMemory* memory) : memory_(memory), staging_(memory) {}

  /// Copies them in place of those of before. The room is kept for the next time.
  void take(const std::vector<Source>& sources);
  /// Where the copy of each lies on the host, once all are there; they hold until the next take(). Another thread may
  /// wait than the one that took them.
  [[nodiscard]] std::vector<const std::byte*> wait() const;

 private:
  struct Part {
    bool fetched;
    std::size_t offset;
  };
  [[nodiscard]] bool begin_fetch(const std::vector<Source>& sources, std::size_t bytes);

  DeviceMemory* memory_;
  std::vector<Part> parts_;
  Array<std::byte> host_;         // copies of what lay on the host
  Array<std::byte> staging_;      // copies on the device
  std::unique_ptr<Fetch> fetch_;  // ends before its staging does; null before there is something to fetch
};

}  // namespace mesogen::exec
