#include "exec/snapshot.hpp"

#include <cstring>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen::exec {

namespace {

/// Room for so many bytes, such that what follows is aligned for any number.
std::size_t room_for(std::size_t bytes) {
  constexpr std::size_t alignment = alignof(std::max_align_t);
  return (bytes + alignment - 1) / alignment * alignment;
}

}  // namespace

void Snapshot::take(const std::vector<Source>& sources) {
  std::size_t on_device = 0;
  for (const Source& source : sources)
    if (source.side == Side::device) on_device += room_for(source.bytes);
  const bool fetches = on_device > 0 && begin_fetch(sources, on_device);
  parts_.clear();
  std::size_t fetched = 0;
  std::size_t copied = 0;
  for (const Source& source : sources) {
    const bool is_fetched = fetches && source.side == Side::device;
    std::size_t& end = is_fetched ? fetched : copied;
    parts_.push_back({is_fetched, end});
    end += room_for(source.bytes);
  }
  host_.resize_for_overwrite(copied);
  std::byte* const host = host_.host(Access::write).data();
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const Source& source = sources[n];
    if (parts_[n].fetched) continue;
    if (source.side == Side::device) {
      memory_->to_host(host + parts_[n].offset, source.place, source.bytes);
    } else {
      std::memcpy(host + parts_[n].offset, source.place, source.bytes);
    }
  }
}

// False if there is no room. A device that fails fails again where its values are copied without room.
bool Snapshot::begin_fetch(const std::vector<Source>& sources, std::size_t bytes) {
  try {
    if (fetch_ == nullptr) fetch_ = memory_->make_fetch();
    staging_.resize_for_overwrite(bytes);
    std::byte* const staging = staging_.device(Access::write);
    std::size_t offset = 0;
    for (const Source& source : sources) {
      if (source.side != Side::device) continue;
      memory_->copy(staging + offset, source.place, source.bytes);
      offset += room_for(source.bytes);
    }
    fetch_->begin(staging, bytes);
  } catch (const Error&) {
    staging_ = Array<std::byte>(memory_);  // its room is better used by the run
    return false;
  }
  return true;
}

std::vector<const std::byte*> Snapshot::wait() const {
  const std::byte* const host = host_.host().data();
  const std::byte* fetched = nullptr;
  std::vector<const std::byte*> places;
  for (const Part& part : parts_) {
    if (part.fetched && fetched == nullptr) fetched = static_cast<const std::byte*>(fetch_->wait());
    places.push_back((part.fetched ? fetched : host) + part.offset);
  }
  return places;
}

}  // namespace mesogen::exec
