#include "test_registry.hpp"

#include <map>
#include <mutex>
#include <sstream>

namespace mesogen::testing {

const PluginRegistry& registry_of(std::string_view folders) {
  static std::mutex mutex;
  static std::map<std::string, PluginRegistry, std::less<>> registries;
  const std::scoped_lock lock(mutex);
  const auto at = registries.find(folders);
  if (at != registries.end()) return at->second;
  std::vector<std::filesystem::path> paths;
  std::istringstream in{std::string(folders)};
  for (std::string folder; std::getline(in, folder, ':');)
    if (!folder.empty()) paths.emplace_back(folder);
  return registries.emplace(folders, PluginRegistry::scan(paths, Twins::first_folder)).first->second;
}

}  // namespace mesogen::testing
