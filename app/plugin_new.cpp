#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "case/declared_sections.hpp"
#include "install.hpp"
#include "options.hpp"
#include "plugin_name.hpp"
#include "text/nearest.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

namespace fs = std::filesystem;

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

std::string read_template(const fs::path& file) {
  std::ifstream in(file);
  if (!in)
    throw Error(
        ExitCode::run_failed,
        fmt::format("the templates of plugins are missing: {} cannot be read; install Mesogen again", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out)
    throw Error(ExitCode::run_failed, fmt::format("{} cannot be written ({})", file.string(), std::strerror(errno)));
}

void prepare_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder, error))
      throw Error(ExitCode::bad_case,
                  fmt::format("{} is there already and is no folder: name another", folder.string()));
    if (!fs::is_empty(folder, error) && !error)
      throw Error(
          ExitCode::bad_case,
          fmt::format("the folder {} is there already and not empty: name another, or remove it", folder.string()));
  }
  if (!error) fs::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::run_failed,
                fmt::format("the folder {} cannot be made ({})", folder.string(), error.message()));
}

std::string use_in_a_case(PluginKind kind, const std::string& name) {
  switch (kind) {
    case PluginKind::kernel: return fmt::format("[kernel]\n    type = \"{}\"", name);
    case PluginKind::boundary: return fmt::format("[domain]\n    boundary = \"{}\"", name);
    case PluginKind::shape: return fmt::format("[solids.{0}]\n    shape = \"{0}\"\n    centre = [0.5, 0.5]", name);
    case PluginKind::initial: return fmt::format("[{}]\n    speed = 0.1", name);
    case PluginKind::physics: return fmt::format("[physics.{0}]\n    type = \"{0}\"\n    force = 0.1", name);
    case PluginKind::observer: return fmt::format("[observers.{0}]\n    type = \"{0}\"\n    interval = 1.0", name);
  }
  return {};
}

/// Writes a plugin that builds, passes its tests and can be used as it is. Returns what to do with it next.
std::string write_plugin(PluginKind kind, const std::string& name, const fs::path& folder) {
  prepare_folder(folder);
  const fs::path templates = installation() / "share" / "mesogen" / "templates";
  const auto write = [&](const fs::path& from, const std::string& to) {
    std::string text = read_template(templates / from);
    replace_all(text, "template_name", name);
    replace_all(text, "TemplateName", class_name(name));
    replace_all(text, "template_kind", to_string(kind));
    write_text(folder / to, text);
  };
  const fs::path of_kind{to_string(kind)};
  const std::string source = name + ".cpp";
  const std::string test = "test_" + name + ".cpp";
  write(of_kind / "template_name.cpp", source);
  write(of_kind / "test_template_name.cpp", test);
  write("CMakeLists.txt", "CMakeLists.txt");

  const std::string where = folder.string();
  std::string text =
      fmt::format("written to {}: {}, {}, CMakeLists.txt\n\nbuild it and test it:\n", where, source, test);
  text += fmt::format("    cmake -S {0} -B {0}/build -DCMAKE_PREFIX_PATH={1}\n", where, installation().string());
  text += fmt::format("    cmake --build {0}/build && ctest --test-dir {0}/build --output-on-failure\n", where);
  text += fmt::format("let Mesogen find it, or install it with: cmake --install {}/build\n", where);
  text += fmt::format("    export MESOGEN_PLUGIN_PATH={}${{MESOGEN_PLUGIN_PATH:+:$MESOGEN_PLUGIN_PATH}}\n",
                      fs::absolute(folder / "build" / "plugins").string());
  text += fmt::format("use it in a case:\n    {}\n", use_in_a_case(kind, name));
  return text;
}

PluginKind kind_of(const std::string& word) {
  std::vector<std::string> words;
  for (const auto kind : plugin_kinds) {
    words.emplace_back(to_string(kind));
    if (words.back() == word) return kind;
  }
  throw Error(ExitCode::bad_case, fmt::format("\"{}\" is no kind of plugin (there are: {}){}", word,
                                              fmt::join(words, ", "), did_you_mean(word, words)));
}

/// Names at the top level of a case that are not those of initial conditions.
std::vector<std::string> section_names() {
  std::vector<std::string> names = {"title"};
  for (const auto& declared : declared_sections())
    if (const std::string& name = declared.section.name;
        !name.empty() && name.find('.') == std::string::npos && !declared.section.plugin_named())
      names.push_back(name);
  return names;
}

struct Options {
  std::string kind;
  std::string name;
  std::string folder;
};

ExitCode write_new(const Options& options) {
  const PluginKind kind = kind_of(options.kind);
  if (const std::string problem = plugin_name_problem(options.name); !problem.empty())
    throw Error(ExitCode::bad_case, problem);
  if (kind == PluginKind::initial)
    if (const std::string taken = nearest(options.name, section_names()); !taken.empty())
      throw Error(ExitCode::bad_case,
                  fmt::format("an initial condition's name is that of its section in a case, and \"{}\" is {} \"{}\", "
                              "a section or key of Mesogen's own: take another name",
                              options.name, options.name == taken ? "taken:" : "too near to", taken));
  const auto registry = load_plugins({}, true);
  if (const auto* twin = registry.find(kind, options.name))
    fmt::print(stderr,
               "warning: there is already a plugin of the kind {} called \"{}\", {}: the two cannot be loaded "
               "together; take another name, "
               "or remove that one\n",
               options.kind, options.name, twin->file.string());
  fmt::print("{}", write_plugin(kind, options.name, options.folder.empty() ? options.name : options.folder));
  return ExitCode::done;
}

}  // namespace

void add_plugin_new(Verb& plugin) {
  const auto options = std::make_shared<Options>();
  Verb& verb = plugin.verb("new", "Write a plugin of your own to start from, with its test",
                           [options] { return write_new(*options); });
  verb.argument("KIND", &options->kind, "kernel, boundary, shape, initial, physics or observer");
  verb.argument("NAME", &options->name, "Name of the plugin, for example my_force");
  verb.argument("DIR", &options->folder, "Folder to write it to (default: NAME)", {.required = false});
}

}  // namespace mesogen::app
