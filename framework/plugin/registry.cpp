#include "plugin/registry.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <tuple>

#include "plugin/instruction_set.hpp"
#include "plugin/loader.hpp"
#include "plugin/named_boundary.hpp"
#include "plugin/plugin_call.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

/// <folder of libmesogen>/mesogen/plugins
fs::path installed_folder() {
  Dl_info info{};
  // Any symbol of this library tells where it lies.
  if (dladdr(reinterpret_cast<const void*>(&installed_folder), &info) == 0 || info.dli_fname == nullptr) return {};
  return fs::absolute(info.dli_fname).parent_path() / "mesogen" / "plugins";
}

std::vector<fs::path> folders_of_environment() {
  std::vector<fs::path> folders;
  const char* value = std::getenv("MESOGEN_PLUGIN_PATH");
  std::istringstream in(value == nullptr ? "" : value);
  for (std::string folder; std::getline(in, folder, ':');)
    if (!folder.empty()) folders.emplace_back(folder);
  return folders;
}

void require_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    throw Error(ExitCode::bad_case, fmt::format("plugin folder {} does not exist or is no folder", folder.string()));
}

auto order(const LoadedPlugin& plugin) {
  return std::tuple(plugin.descriptor->kind, std::string_view(plugin.descriptor->name));
}

}  // namespace

std::string_view to_string(PluginKind kind) {
  switch (kind) {
    case PluginKind::kernel: return "kernel";
    case PluginKind::boundary: return "boundary";
    case PluginKind::physics: return "physics";
    case PluginKind::observer: return "observer";
    case PluginKind::initial: return "initial";
    case PluginKind::shape: return "shape";
  }
  return "plugin";
}

PluginRegistry PluginRegistry::only(const std::vector<fs::path>& folders) {
  PluginRegistry registry;
  for (const auto& folder : folders) {
    require_folder(folder);
    registry.add_folder(folder);
  }
  registry.sort();
  return registry;
}

PluginRegistry PluginRegistry::scan(const std::vector<fs::path>& folders, Twins twins) {
  PluginRegistry registry;
  registry.twins_ = twins;
  for (const auto& folder : folders) {
    require_folder(folder);
    registry.add_folder(folder);
  }
  for (const auto& folder : folders_of_environment()) {
    if (std::error_code ignored; !fs::is_directory(folder, ignored))
      registry.refused_.push_back({folder, "MESOGEN_PLUGIN_PATH names it, but there is no such folder"});
    registry.add_folder(folder);
  }
  registry.add_folder(installed_folder());
  registry.sort();
  return registry;
}

void PluginRegistry::add_folder(const fs::path& folder) {
  std::error_code error;
  const fs::path where = fs::canonical(folder, error);
  if (error || !fs::is_directory(where, error)) return;
  if (std::ranges::find(folders_, where) != folders_.end()) return;
  folders_.push_back(where);
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(where, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".so" && !fs::is_directory(entry->status())) files.push_back(entry->path());
  if (error) refused_.push_back({where, "the folder cannot be read (" + error.message() + ")"});
  std::ranges::sort(files);
  of_earlier_folders_ = plugins_.size();
  for (const auto& file : files) add_file(file);
}

void PluginRegistry::add_file(const fs::path& file) {
  const auto [chosen, instruction_set] = plugin::best_variant(file, plugin::usable_instruction_sets());
  const plugin::LoadResult loaded = plugin::load(chosen);
  if (loaded.descriptor == nullptr) {
    refused_.push_back({chosen, loaded.problem});
    return;
  }
  const auto& found = *loaded.descriptor;
  if (const auto* other = find(found.kind, found.name)) {
    // A link to a file that was loaded already is no second plugin.
    if (std::error_code ignored; fs::equivalent(other->file, chosen, ignored)) return;
    const auto place = static_cast<std::size_t>(other - plugins_.data());
    if (twins_ == Twins::first_folder && place < of_earlier_folders_) return;
    throw Error(ExitCode::plugin_refused,
                fmt::format("two plugins of the kind {} are called \"{}\": {} and {}; remove or rename one",
                            to_string(found.kind), found.name, other->file.string(), chosen.string()));
  }
  plugins_.push_back({loaded.descriptor, chosen, instruction_set});
}

void PluginRegistry::sort() { std::ranges::sort(plugins_, {}, order); }

const LoadedPlugin* PluginRegistry::find(PluginKind kind, std::string_view name) const {
  const auto found = std::ranges::find_if(
      plugins_, [&](const LoadedPlugin& p) { return p.descriptor->kind == kind && p.descriptor->name == name; });
  return found == plugins_.end() ? nullptr : &*found;
}

std::vector<std::string> PluginRegistry::names(PluginKind kind) const {
  std::vector<std::string> names;
  for (const auto& plugin : plugins_)
    if (plugin.descriptor->kind == kind) names.emplace_back(plugin.descriptor->name);
  return names;
}

std::vector<std::string> PluginRegistry::refusals() const {
  std::vector<std::string> lines;
  lines.reserve(refused_.size());
  for (const auto& refused : refused_) lines.push_back(fmt::format("{}: {}", refused.file.string(), refused.reason));
  return lines;
}

Error PluginRegistry::missing(PluginKind kind, std::string_view name) const {
  const auto known = names(kind);
  return missing(fmt::format("{} plugin", to_string(kind)), name, known,
                 fmt::format("there are: {}", fmt::join(known, ", ")));
}

Error PluginRegistry::missing(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& plugin : plugins_) known.emplace_back(plugin.descriptor->name);
  return missing("plugin", name, known, "see `mesogen plugin list`");
}

Error PluginRegistry::missing(std::string_view what, std::string_view name, const std::vector<std::string>& known,
                              std::string_view all) const {
  constexpr std::string_view own_plugins =
      "a plugin of your own is found with --plugin-path DIR or MESOGEN_PLUGIN_PATH=DIR, DIR being its folder "
      "build/plugins";
  for (const auto& refused : refused_)
    if (refused.file.stem() == name)
      return {ExitCode::plugin_refused,
              fmt::format("the {} \"{}\" was refused: {}: {}", what, name, refused.file.string(), refused.reason)};
  if (known.empty())
    return {ExitCode::bad_case,
            fmt::format("there is no {} at all; looked in: {}; {}", what, fmt::join(paths(), ", "), own_plugins)};
  return {ExitCode::bad_case,
          fmt::format("no {} is called \"{}\" ({}){}; {}", what, name, all, did_you_mean(name, known), own_plugins)};
}

std::vector<std::string> PluginRegistry::paths() const {
  std::vector<std::string> paths;
  for (const auto& folder : folders_) paths.push_back(folder.string());
  return paths;
}

namespace {

void require_dimension(const PluginDescriptor& plugin, int dimension) {
  if (!plugin.dimensions.contains(dimension))
    throw Error(ExitCode::bad_case,
                fmt::format("the {} plugin \"{}\" has no form for {} dimensions: it has {} for {}; a scene has as many "
                            "dimensions as domain.size has numbers",
                            to_string(plugin.kind), plugin.name, dimension,
                            plugin.dimensions.list().size() == 1 ? "one" : "forms", plugin.dimensions.text()));
  if (!built_dimensions.contains(dimension))
    throw Error(ExitCode::bad_case,
                fmt::format("this Mesogen is built for {} dimensions, not for {}", built_dimensions.text(), dimension));
}

/// A new object of a plugin whose kind is that of Base.
template <class Base>
PluginPointer<Base> create(const PluginDescriptor& plugin, Precision precision, int dimension) {
  require_dimension(plugin, dimension);
  void* object = call_plugin(plugin.name, "constructor", [&] { return plugin.create(precision, dimension); });
  if (object == nullptr)
    throw Error(ExitCode::bad_case, fmt::format("the {} plugin \"{}\" has no form for {} dimensions in {} precision",
                                                to_string(plugin.kind), plugin.name, dimension, to_string(precision)));
  return {static_cast<Base*>(object), DeletePlugin{plugin.name}};
}

/// The same of a plugin whose class does not depend on the precision.
template <class Base>
PluginPointer<Base> create(const PluginDescriptor& plugin, int dimension) {
  return create<Base>(plugin, Precision::double_precision, dimension);
}

}  // namespace

DimensionSet usable_dimensions(const PluginDescriptor& plugin) { return plugin.dimensions.common(built_dimensions); }

const PluginDescriptor& PluginRegistry::descriptor(PluginKind kind, std::string_view name) const {
  const auto* plugin = find(kind, name);
  if (plugin == nullptr) throw missing(kind, name);
  return *plugin->descriptor;
}

int PluginRegistry::smallest_dimension(PluginKind kind, std::string_view name) const {
  const PluginDescriptor& plugin = descriptor(kind, name);
  const std::vector<int> usable = usable_dimensions(plugin).list();
  if (usable.empty()) require_dimension(plugin, built_dimensions.list().front());
  return usable.front();
}

PluginPointer<Kernel> PluginRegistry::make_kernel(std::string_view name, int dimension) const {
  return create<Kernel>(descriptor(PluginKind::kernel, name), dimension);
}

std::unique_ptr<Boundary> PluginRegistry::make_boundary(std::string_view name, int dimension,
                                                        std::string length_unit) const {
  return std::make_unique<NamedBoundary>(
      std::string(name), create<Boundary>(descriptor(PluginKind::boundary, name), dimension), std::move(length_unit));
}

PluginPointer<Shape> PluginRegistry::make_shape(std::string_view name, int dimension) const {
  return create<Shape>(descriptor(PluginKind::shape, name), dimension);
}

PluginPointer<Initial> PluginRegistry::make_initial(std::string_view name, int dimension) const {
  return create<Initial>(descriptor(PluginKind::initial, name), dimension);
}

PluginPointer<Observer> PluginRegistry::make_observer(std::string_view name, int dimension) const {
  return create<Observer>(descriptor(PluginKind::observer, name), dimension);
}

PluginPointer<Physics> PluginRegistry::make_physics(std::string_view name, Precision precision, int dimension) const {
  return create<Physics>(descriptor(PluginKind::physics, name), precision, dimension);
}

bool PluginRegistry::has_cuda(std::string_view physics) const {
  const auto* const plugin = find(PluginKind::physics, physics);
  return plugin != nullptr && !plugin::cuda_variant(plugin->file, plugin->instruction_set).empty();
}

PluginRegistry::CudaTwin PluginRegistry::cuda_twin(std::string_view physics) const {
  const auto* const plugin = find(PluginKind::physics, physics);
  if (plugin == nullptr) throw missing(PluginKind::physics, physics);
  const fs::path file = plugin::cuda_variant(plugin->file, plugin->instruction_set);
  const plugin::LoadResult loaded = plugin::load(file);
  const auto refused = [&](const std::string& reason) {
    return CudaTwin{
        nullptr, fmt::format("the physics plugin \"{}\" for CUDA was refused: {}: {}", physics, file.string(), reason)};
  };
  if (loaded.descriptor == nullptr) return refused(loaded.problem);
  const auto whole_name = [](const PluginDescriptor& one) {
    return fmt::format("{} {} {}", to_string(one.kind), one.name, one.version);
  };
  const std::string name = whole_name(*loaded.descriptor);
  if (name != whole_name(*plugin->descriptor))
    return refused(fmt::format("it is {}, where {} is {}: build both again", name, plugin->file.string(),
                               whole_name(*plugin->descriptor)));
  return {loaded.descriptor, {}};
}

std::string PluginRegistry::cuda_problem(std::string_view physics) const { return cuda_twin(physics).problem; }

PluginPointer<Physics> PluginRegistry::make_physics_for_cuda(std::string_view name, Precision precision,
                                                             int dimension) const {
  const CudaTwin twin = cuda_twin(name);
  if (twin.descriptor == nullptr) throw Error(ExitCode::plugin_refused, twin.problem);
  return create<Physics>(*twin.descriptor, precision, dimension);
}

}  // namespace mesogen
