#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "domain/neighbourhood.hpp"
#include "exec/memory.hpp"
#include "field/field.hpp"
#include "mesogen/plugin/boundary.hpp"

namespace mesogen {

/// How each field goes over to the copies beyond the faces, as the boundary says: asked once for each sorting.
class CopyRules {
 public:
  explicit CopyRules(exec::Memory& memory) : memory_(memory) {}

  /// Rules, copy by copy; null if all take the values of their sources.
  const Extension* of(const Field& field, const Scene& scene, const Boundary& boundary,
                      const Neighbourhood& neighbourhood);

 private:
  exec::Memory& memory_;
  std::map<std::string, exec::Array<Extension>, std::less<>> rules_;  // by field; empty: the same
  std::uint64_t sorted_version_ = 0;
};

}  // namespace mesogen
