#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesogen/export.hpp"

namespace mesogen::output {

/// A unit as the units module of H5MD spells it: factors with signed powers, separated by spaces. "m/s" becomes "m
/// s-1", "kg/(m3 s)" "kg m-3 s-1", "m2/s" "m+2 s-1"; "1" and what is spelled so already stay. A slash divides by the
/// factor or the parenthesis after it. Empty where the text is no product of SI units ("particle spacings"; "m, m,
/// rad", the columns of a table).
MESOGEN_EXPORT std::optional<std::string> h5md_unit(std::string_view text);

}  // namespace mesogen::output
