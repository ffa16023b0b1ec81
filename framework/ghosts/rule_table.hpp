#pragma once

#include <vector>

#include "exec/memory.hpp"
#include "ghosts/views.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// Rules of one field, stored as briefly as they allow: nothing where all values stay the same, two numbers per
/// component where none mixes components.
class MESOGEN_EXPORT RuleTable {
 public:
  RuleTable(const std::vector<AffineRule>& rules, exec::Memory& memory);

  [[nodiscard]] RuleView view() const { return {components_, diagonal_, numbers_.empty() ? nullptr : numbers_.data()}; }

 private:
  int components_ = 0;
  bool diagonal_ = true;
  exec::Array<double> numbers_;
};

}  // namespace mesogen
