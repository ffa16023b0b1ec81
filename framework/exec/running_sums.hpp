#pragma once

#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// On the host: values[i] becomes the sum of all before it, values[count] the sum of all, which it returns.
MESOGEN_EXPORT Index running_sums(Index* values, Index count);

}  // namespace mesogen::exec
