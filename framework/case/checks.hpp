#pragma once

#include "case/case.hpp"

namespace mesogen {

/// Checks that concern several keys together. Skips those whose keys were refused already.
void check_case(const Case& source, Problems& problems);

}  // namespace mesogen
