#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen::plugin {

/// Instruction sets that plugins may be built for beside the baseline, that this processor has, best first. The
/// variable MESOGEN_SIMD (baseline, x86-64-v3 or x86-64-v4) caps them; Error if it holds another word.
MESOGEN_EXPORT std::vector<std::string> usable_instruction_sets();

/// The same, for a given processor (all that it has, best first) and cap (empty: none).
MESOGEN_EXPORT std::vector<std::string> capped(const std::vector<std::string>& sets, std::string_view cap);

/// What to tell who runs code that was `built` for less than the best of `sets`, which the processor has; or empty.
MESOGEN_EXPORT std::string narrow_code_text(std::string_view built, const std::vector<std::string>& sets);

struct Variant {
  std::filesystem::path file;
  std::string instruction_set;
};

/// Which file to load for a plugin: the one of the same name in a sub-folder named like the best of `sets`, or itself.
MESOGEN_EXPORT Variant best_variant(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// The library for CUDA of the plugin whose library for some instruction set this is; empty if there is none.
MESOGEN_EXPORT std::filesystem::path cuda_variant(const std::filesystem::path& file, std::string_view instruction_set);

}  // namespace mesogen::plugin
