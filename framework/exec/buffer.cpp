#include "mesogen/exec/buffer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "exec/large_pages.hpp"

namespace mesogen::exec {

namespace {

// Ghosts come and go: a buffer that has grown once is likely to grow again.
std::size_t room_for(std::size_t bytes, std::size_t before) { return before == 0 ? bytes : bytes + bytes / 16; }

std::byte* at(void* place, std::size_t offset) { return static_cast<std::byte*>(place) + offset; }
const std::byte* at(const void* place, std::size_t offset) { return static_cast<const std::byte*>(place) + offset; }

}  // namespace

Buffer::Buffer(const Buffer& other) : memory_(other.memory_) { *this = other; }

Buffer& Buffer::operator=(const Buffer& other) {
  if (this == &other) return *this;
  resize_for_overwrite(other.bytes_);
  copy(other, 0, other.bytes_, 0);
  return *this;
}

Buffer::~Buffer() { release(); }

void Buffer::release() noexcept {
  release_large(host_);
  if (memory_ != nullptr) memory_->release(device_, capacity_);
  host_ = device_ = nullptr;
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(host_, other.host_);
  std::swap(device_, other.device_);
  std::swap(host_valid_, other.host_valid_);
  std::swap(device_valid_, other.device_valid_);
  std::swap(bytes_, other.bytes_);
  std::swap(capacity_, other.capacity_);
}

void Buffer::resize(std::size_t bytes) {
  const std::size_t kept = std::min(bytes, bytes_);
  if (bytes > capacity_) {
    Buffer larger(memory_);
    larger.resize_for_overwrite(room_for(bytes, capacity_));
    larger.copy(*this, 0, kept, 0);
    swap(larger);
  }
  bytes_ = bytes;
  zero(kept);
}

void Buffer::zero(std::size_t first) {
  if (first == bytes_) return;
  // Where both sides would do, on the device: most likely that is where the bytes are needed next.
  if (memory_ != nullptr && device_valid_) {
    memory_->zero(at(access(Side::device, Access::read_write), first), bytes_ - first);
  } else {
    std::memset(at(access(Side::host, Access::read_write), first), 0, bytes_ - first);
  }
}

void Buffer::resize_for_overwrite(std::size_t bytes) {
  if (bytes > capacity_) {
    const std::size_t room = room_for(bytes, capacity_);
    release();
    bytes_ = capacity_ = 0;  // if there is no room now
    if (memory_ == nullptr) host_ = allocate_large(room);
    capacity_ = room;
  }
  bytes_ = bytes;
  if (memory_ == nullptr) return;
  host_valid_ = device_valid_ = true;
  for (void* const side : {host_, device_})
    if (side != nullptr) memory_->mark_stale(side, capacity_);
}

void Buffer::copy(const Buffer& from, std::size_t first, std::size_t bytes, std::size_t to) {
  if (bytes == 0) return;
  const Access purpose = bytes == bytes_ ? Access::write : Access::read_write;
  const bool on_device = memory_ != nullptr && memory_ == from.memory_ && from.device_ != nullptr && from.device_valid_;
  if (on_device) {
    memory_->copy(at(access(Side::device, purpose), to), at(from.device_, first), bytes);
  } else {
    std::memcpy(at(access(Side::host, purpose), to), at(from.read(Side::host), first), bytes);
  }
}

void Buffer::make_room(Side side) const {
  void*& place = side == Side::host ? host_ : device_;
  if (place != nullptr || capacity_ == 0) return;
  place = side == Side::host ? allocate_large(capacity_) : memory_->allocate(capacity_);
  memory_->mark_stale(place, capacity_);
}

void Buffer::bring_to(Side side) const {
  make_room(side);
  if (side == Side::host ? host_valid_ : device_valid_) return;
  // Without bytes there may be no room on either side.
  if (bytes_ != 0 && side == Side::host) memory_->to_host(host_, device_, bytes_);
  if (bytes_ != 0 && side == Side::device) memory_->to_device(device_, host_, bytes_);
  host_valid_ = device_valid_ = true;
}

void* Buffer::access_in_turn(Side side, Access access) {
  if (access == Access::write) {
    make_room(side);
  } else {
    bring_to(side);
  }
  const bool to_host = side == Side::host;
  if (access != Access::read) {
    void* const other = to_host ? device_ : host_;
    bool& other_valid = to_host ? device_valid_ : host_valid_;
    if (other != nullptr && other_valid) memory_->mark_stale(other, capacity_);
    other_valid = false;
    (to_host ? host_valid_ : device_valid_) = true;
  }
  return to_host ? host_ : device_;
}

}  // namespace mesogen::exec
