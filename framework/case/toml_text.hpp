#pragma once

#include <string>
#include <string_view>

#include "case/value.hpp"

namespace mesogen {

/// The shortest TOML float that reads back to the same number: "0.1", "4.0", "1e-05".
std::string number_text(double value);
/// A TOML basic string, in quotes.
std::string text_literal(std::string_view text);
/// A value on one line, as it may stand behind `key = `.
MESOGEN_EXPORT std::string inline_text(const Value& value);
/// The same for a message: shortened if it is long.
std::string shown(const Value& value);
/// A whole table as a TOML document.
MESOGEN_EXPORT std::string document_text(const Value& root);

}  // namespace mesogen
