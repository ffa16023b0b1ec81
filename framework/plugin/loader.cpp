#include "plugin/loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <string_view>
#include <system_error>

#include "plugin/library_file.hpp"
#include "plugin/plugin_call.hpp"

namespace mesogen::plugin {

namespace {

constexpr const char* exported_name = "mesogen_plugin";

bool is_name(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

/// Does this address lie in a loaded library? A pointer from an unknown file is not followed before.
bool is_mapped(const void* address) {
  Dl_info info{};
  return address != nullptr && dladdr(address, &info) != 0;
}

}  // namespace

std::string descriptor_problem(const PluginDescriptor& descriptor) {
  if (descriptor.magic != descriptor_magic) return "what it exports as `mesogen_plugin` is not a plugin descriptor";
  if (descriptor.abi != abi_number)
    return fmt::format("it was built for plugin interface {}, this Mesogen has {}; build it again", descriptor.abi,
                       abi_number);
  if (descriptor.size != sizeof(PluginDescriptor))
    return fmt::format("its descriptor has {} bytes, this Mesogen expects {}; build it again", descriptor.size,
                       sizeof(PluginDescriptor));
  if (descriptor.build_tag == nullptr || descriptor.build_tag != std::string_view(MESOGEN_BUILD_TAG))
    return fmt::format("it was built with {}, this Mesogen with {}; build it again with the same compiler",
                       descriptor.build_tag == nullptr ? "(unknown)" : descriptor.build_tag, MESOGEN_BUILD_TAG);
  if (descriptor.kind < PluginKind::kernel || descriptor.kind > PluginKind::shape)
    return fmt::format("its kind is {}; kinds are 1 to 6", static_cast<int>(descriptor.kind));
  if (descriptor.name == nullptr || !is_name(descriptor.name))
    return fmt::format("its name \"{}\" is not made of small letters, digits and underscores",
                       descriptor.name == nullptr ? "" : descriptor.name);
  if (descriptor.version == nullptr || descriptor.summary == nullptr || descriptor.create == nullptr)
    return "its descriptor lacks a version, a summary or a factory";
  if (descriptor.dimensions.common(DimensionSet(AllDimensions{})).empty())
    return fmt::format("it has no form in any dimension: there are {}", DimensionSet(AllDimensions{}).text());
  return {};
}

LoadResult load(const std::filesystem::path& file) {
  if (auto problem = library_problem(file); !problem.empty()) return {nullptr, std::move(problem)};

  // RTLD_NODELETE: code of a plugin may run until the very end (destructors, threads), so nothing ever unloads it.
  namespace dll = boost::dll;
  const auto mode =
      dll::load_mode::rtld_now | dll::load_mode::rtld_local | static_cast<dll::load_mode::type>(RTLD_NODELETE);
  dll::shared_library library;
  std::error_code error;
  {
    const PluginCall loading{.plugin = file.native(), .call = "loading"};
    const CallUnderWay under_way(loading);  // constructors of its static objects run
    library.load(file, error, mode);
  }
  if (!library.is_loaded()) {
    const char* reason = dlerror();
    return {nullptr, fmt::format("the dynamic linker refuses it: {}", reason != nullptr ? reason : error.message())};
  }
  if (!library.has(exported_name)) return {nullptr, "it exports no `mesogen_plugin`, so it is not a Mesogen plugin"};

  const void* address = library.get<const void*>(exported_name);
  if (!is_mapped(address)) return {nullptr, "what it exports as `mesogen_plugin` is not a plugin descriptor"};
  const auto* descriptor = static_cast<const PluginDescriptor*>(address);
  std::string problem = descriptor_problem(*descriptor);
  if (!problem.empty()) return {nullptr, std::move(problem)};
  return {descriptor, {}};
}

}  // namespace mesogen::plugin
