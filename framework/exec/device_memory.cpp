#include "mesogen/exec/device_memory.hpp"

#include <fmt/format.h>

#include "exec/fetch.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::exec {

namespace {

std::string text_of(std::size_t bytes) {
  const auto number = static_cast<double>(bytes);
  return number < 1e9 ? fmt::format("{:.3g} MB", number / 1e6) : fmt::format("{:.3g} GB", number / 1e9);
}

}  // namespace

DeviceMemory::~DeviceMemory() = default;
Fetch::~Fetch() = default;

void* DeviceMemory::allocate(std::size_t bytes) {
  const Room now = room();
  const bool fits = static_cast<double>(bytes) <= usable * static_cast<double>(now.free);
  void* const place = fits ? take(bytes) : nullptr;
  if (place == nullptr)
    throw Error(ExitCode::run_failed,
                fmt::format("{} has too little memory: an array needs {}, and of its {} only {} are free, of which a "
                            "tenth is left alone (this run holds {} there). Take fewer particles (a larger "
                            "particles.spacing), run.precision = \"single\", or run.device = \"cpu\"",
                            device_, text_of(bytes), text_of(now.total), text_of(now.free), text_of(held_)));
  held_ += bytes;
  return place;
}

void DeviceMemory::release(void* place, std::size_t bytes) noexcept {
  if (place == nullptr) return;
  give_back(place);
  held_ -= bytes;
}

}  // namespace mesogen::exec
