#pragma once

#include <vector>

#include "case/declared_keys.hpp"
#include "json.hpp"

namespace mesogen::app {

/// JSON Schema (draft 7) of the values that a key takes: type, range, choices, default, and what it means.
Json key_schema(const DeclaredKey& key);

/// JSON Schema of a table that holds these keys and no others. "bulk.A" is key A of the table `bulk` in it.
Json table_schema(const std::vector<DeclaredKey>& keys);

}  // namespace mesogen::app
