#pragma once

#include <optional>

#include "case/value.hpp"

namespace mesogen {

/// What a case gives in place of a number, or a list of numbers, that may vary (Parameter::may_vary); nothing where it
/// gives numbers.
struct GivenValue {
  std::optional<Value> value;
};

}  // namespace mesogen
