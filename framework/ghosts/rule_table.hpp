#pragma once

#include <vector>

#include "ghosts/views.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// Rules of one field, stored as briefly as they allow: nothing where all values stay the same, two numbers per
/// component where none mixes components.
class MESOGEN_EXPORT RuleTable {
 public:
  RuleTable(const std::vector<AffineRule>& rules, exec::DeviceMemory* memory);

  [[nodiscard]] RuleView view(exec::Side side) const {
    return {components_, diagonal_, numbers_.empty() ? nullptr : numbers_.on(side)};
  }

 private:
  int components_ = 0;
  bool diagonal_ = true;
  exec::Array<double> numbers_;
};

}  // namespace mesogen
