#include "room.hpp"

#include <string>
#include <system_error>

#include "diagnostics/resources.hpp"
#include "forecast/disk.hpp"

namespace mesogen::app {

SetUpWith with_settings(const CaseOptions& options, const PluginRegistry& registry) {
  return [&options, &registry](const std::vector<std::string>& settings) {
    CaseOptions changed = options;
    changed.overrides.insert(changed.overrides.end(), settings.begin(), settings.end());
    return set_up(changed, registry);
  };
}

double free_disk(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (!error && there.has_relative_path() && !std::filesystem::exists(there)) there = there.parent_path();
  const auto space = std::filesystem::space(there, error);
  return error ? 0.0 : static_cast<double>(space.available);
}

void refuse_far_beyond_memory(const Case& source, double program, const SetUpWith& set_up_with) {
  Problems problems;
  mesogen::refuse_far_beyond_memory(source, static_cast<double>(available_memory()), program, set_up_with, problems);
  problems.throw_if_any();
}

void refuse_beyond_memory(const Setup& setup, double program, const SetUpWith& set_up_with) {
  Problems problems;
  mesogen::refuse_beyond_memory(setup, forecast_memory(setup, program), static_cast<double>(available_memory()),
                                program, set_up_with, problems);
  problems.throw_if_any();
}

void warn_of_limits(const Setup& setup, const std::filesystem::path& folder, Log& log) {
  if (const auto excess = beyond_disk(setup, free_disk(folder))) log.warn(excess->key + ": " + excess->text);
  if (const std::string text = beyond_steps(setup, forecast_steps(setup)); !text.empty()) log.warn(text);
}

}  // namespace mesogen::app
