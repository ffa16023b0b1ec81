#include "plugin_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace mesogen::app {

namespace {

constexpr std::array<std::string_view, 85> keywords{
    "alignas",   "alignof",  "and",        "and_eq",    "asm",          "auto",          "bitand",
    "bitor",     "bool",     "break",      "case",      "catch",        "char",          "char16_t",
    "char32_t",  "char8_t",  "class",      "co_await",  "co_return",    "co_yield",      "compl",
    "concept",   "const",    "const_cast", "consteval", "constexpr",    "constinit",     "continue",
    "decltype",  "default",  "delete",     "do",        "double",       "dynamic_cast",  "else",
    "enum",      "explicit", "export",     "extern",    "false",        "float",         "for",
    "friend",    "goto",     "if",         "inline",    "int",          "long",          "mutable",
    "namespace", "new",      "noexcept",   "not",       "not_eq",       "nullptr",       "operator",
    "or",        "or_eq",    "private",    "protected", "public",       "register",      "requires",
    "return",    "short",    "signed",     "sizeof",    "static",       "static_assert", "static_cast",
    "struct",    "switch",   "template",   "this",      "thread_local", "throw",         "true",
    "try",       "typedef",  "typeid",     "typename",  "union",        "unsigned",      "using",
    "virtual"};

// Targets that a build has by itself, and one of Mesogen's own.
constexpr std::array<std::string_view, 11> targets{"all",      "clean",         "depend",  "edit_cache",
                                                   "help",     "install",       "package", "package_source",
                                                   "programs", "rebuild_cache", "test"};

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::ranges::find(list, word) != list.end();
}

}  // namespace

std::string plugin_name_problem(std::string_view name) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty()) return "a plugin needs a name, such as my_force";
  if (!std::ranges::all_of(name, allowed) || name.front() < 'a' || name.back() == '_' ||
      name.find("__") != std::string_view::npos)
    return fmt::format(
        "\"{}\" cannot be the name of a plugin: use small letters and digits, with single underscores between them, "
        "and begin with a letter, such as my_force",
        name);
  if (contains(keywords, name))
    return fmt::format("\"{}\" cannot be the name of a plugin: it is a word of C++; take another, such as my_{}", name,
                       name);
  if (name == "mesogen" || name.starts_with("mesogen_"))
    return fmt::format(
        "\"{}\" cannot be the name of a plugin: a build target of Mesogen has this name; take another, such as "
        "my_plugin",
        name);
  if (contains(targets, name))
    return fmt::format(
        "\"{}\" cannot be the name of a plugin: builds have a target of this name; take another, such "
        "as my_{}",
        name, name);
  return {};
}

std::string class_name(std::string_view name) {
  std::string text;
  bool first = true;
  for (const char c : name) {
    if (c != '_') text += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    first = c == '_';
  }
  return text;
}

}  // namespace mesogen::app
