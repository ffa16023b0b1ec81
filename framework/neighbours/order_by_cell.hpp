#pragma once

#include <cstdint>

#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// On the host: place n takes what stood at order[n], by cell and by id within a cell. So the order of sums depends on
/// positions alone.
MESOGEN_EXPORT void order_by_cell(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order);

}  // namespace mesogen::exec
