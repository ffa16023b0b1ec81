#pragma once

#include <string>

#include "case/case.hpp"
#include "exec/backend.hpp"
#include "plugin/registry.hpp"

namespace mesogen {

/// Where a case computes.
struct BackendChoice {
  const Backend* backend = &Backend::host();
  std::string why_on_host;  ///< where a device would have been taken, had it been possible
  std::string problem;      ///< why the case cannot have what it asks for; empty if it can
};

BackendChoice choose_backend(const Case& source, const PluginRegistry& registry);

}  // namespace mesogen
