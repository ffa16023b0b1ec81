#pragma once

#include "case/case.hpp"

namespace mesogen {

/// Fills a case from its `tree` and `file`, section by section.
void read_sections(Case& target, Problems& problems);

}  // namespace mesogen
