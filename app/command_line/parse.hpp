#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "command_line/verb.hpp"

namespace mesogen::app {

/// What these words ask for: the action of a verb, whose options have their values by now, or its help. The action is
/// valid as long as `verb`. Throws Error(bad_case) that tells what to write instead.
Action parse(Verb& verb, std::span<const std::string> words);

/// The number that the whole text is; empty if it is none.
std::optional<double> number(std::string_view text);

}  // namespace mesogen::app
