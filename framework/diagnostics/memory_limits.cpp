#include "diagnostics/memory_limits.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace mesogen {

namespace {

namespace fs = std::filesystem;

/// The names of the files of a version of control groups.
struct Files {
  const char* limit;
  const char* used;
  const char* droppable;  ///< in memory.stat
};
constexpr Files version_2{"memory.max", "memory.current", "inactive_file"};
constexpr Files version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};

/// Nothing where there is no such file, or it holds a word, such as "max".
std::optional<double> number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0.0;
  return stream >> number ? std::optional(number) : std::nullopt;
}

double droppable_in(const fs::path& group, const std::string& name) {
  std::ifstream stream(group / "memory.stat");
  double number = 0.0;
  for (std::string word; stream >> word >> number;)
    if (word == name) return number;
  return 0.0;
}

void take_least(std::optional<double>& least, std::optional<double> other) {
  if (other && (!least || *other < *least)) least = std::max(0.0, *other);
}

std::optional<double> left_in(const fs::path& group, const Files& files) {
  constexpr double none = 1e18;  // version 1 writes a number near 2^63 where there is no limit
  const auto limit = number_in(group / files.limit);
  const auto used = number_in(group / files.used);
  if (!limit || !used || *limit > none) return std::nullopt;
  return *limit - *used + droppable_in(group, files.droppable);
}

/// `group`: "/slice/job", below the folder where the groups are mounted. In a container it may lie outside of what is
/// mounted, whose top is the container's own group then.
std::optional<double> left_around(const fs::path& mount, const std::string& group, const Files& files) {
  std::optional<double> least;
  fs::path below = fs::path(group).relative_path();
  while (true) {
    take_least(least, left_in(mount / below, files));
    if (below.empty()) return least;
    below = below.parent_path();
  }
}

}  // namespace

std::optional<double> memory_left_in_groups(const fs::path& root) {
  std::optional<double> least;
  std::ifstream lines(root / "proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    // "0::/slice/job" of version 2, "4:cpu,memory:/slice/job" of version 1
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string group = line.substr(second + 1);
    if (controllers == ",,") take_least(least, left_around(root / "sys/fs/cgroup", group, version_2));
    if (controllers.find(",memory,") != std::string::npos)
      take_least(least, left_around(root / "sys/fs/cgroup/memory", group, version_1));
  }
  return least;
}

std::optional<double> address_space_left() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  const auto pages = number_in("/proc/self/statm");
  if (!pages) return std::nullopt;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace mesogen
