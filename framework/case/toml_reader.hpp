#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "case/problems.hpp"
#include "case/value.hpp"

namespace mesogen {

/// The table that a TOML text holds; null, and a problem with its place, if it is not valid. `name` stands for the
/// file.
std::unique_ptr<Value> parse_toml(std::string_view text, const std::string& name, Problems& problems);

/// Applies "physics.activity.activity=0.05" to a case. The value is TOML, or else taken as a text.
void apply_override(Value& root, const std::string& text, Problems& problems);

/// The content of a file; a problem if it cannot be read or is too large to be a case.
std::string read_text_file(const std::string& path, Problems& problems);

}  // namespace mesogen
