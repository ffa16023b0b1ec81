#include "diagnostics/resources.hpp"

#include <ctime>
#include <fstream>
#include <string>

#include "diagnostics/memory_limits.hpp"

namespace mesogen {

namespace {

/// A line such as "VmHWM:   1234 kB", in bytes; 0 if there is none.
std::int64_t bytes_in(const char* file, const std::string& name) {
  std::ifstream lines(file);
  for (std::string word; lines >> word;) {
    if (word != name) continue;
    std::int64_t kibibytes = 0;
    lines >> kibibytes;
    return 1024 * kibibytes;
  }
  return 0;
}

}  // namespace

double cpu_seconds() {
  timespec time{};
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) != 0) return 0.0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::int64_t peak_memory() { return bytes_in("/proc/self/status", "VmHWM:"); }

std::int64_t resident_memory() { return bytes_in("/proc/self/status", "VmRSS:"); }

std::int64_t available_memory() {
  std::int64_t least = bytes_in("/proc/meminfo", "MemAvailable:");
  for (const auto& left : {memory_left_in_groups("/"), address_space_left()})
    if (left && (least == 0 || *left < static_cast<double>(least))) least = static_cast<std::int64_t>(*left);
  return least;
}

}  // namespace mesogen
