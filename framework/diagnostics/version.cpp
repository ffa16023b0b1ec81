#include "diagnostics/version.hpp"

#include <fmt/format.h>

#include "mesogen/diagnostics/build_tag.hpp"

namespace mesogen {

std::string_view version() { return MESOGEN_VERSION; }

std::string build_text() {
#if defined(__clang__)
  const auto compiler = fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const auto compiler = fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
  return fmt::format("{}, {}, {}", compiler, MESOGEN_BUILD_TYPE, MESOGEN_BUILD_TAG);
}

}  // namespace mesogen
