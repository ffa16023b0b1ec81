#include "case/toml_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "case/toml_text.hpp"

namespace mesogen {

namespace {

SourcePlace place_of(const toml::source_region& source, const std::string& name) {
  return {name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

/// Turns what toml++ read into our tree, and tables, which it sorts by key, back into the order of the file.
class Converter {
 public:
  explicit Converter(const std::string& name) : name_(name) {}

  Value operator()(const toml::node& node) const {
    Value value;
    value.place = place_of(node.source(), name_);
    node.visit([&](const auto& typed) { value.content = content(typed); });
    return value;
  }

 private:
  using Content = Value::Content;

  static Content content(const toml::value<bool>& node) { return node.get(); }
  static Content content(const toml::value<std::int64_t>& node) { return node.get(); }
  static Content content(const toml::value<double>& node) { return node.get(); }
  static Content content(const toml::value<std::string>& node) { return node.get(); }
  template <class Date>
  static Content content(const toml::value<Date>& node) {
    std::ostringstream text;
    text << node.get();
    return Value::Date{text.str()};
  }
  Content content(const toml::array& nodes) const {
    Value::List list;
    list.reserve(nodes.size());
    for (const auto& node : nodes) list.push_back((*this)(node));
    return list;
  }
  Content content(const toml::table& nodes) const {
    Value::Table table;
    table.reserve(nodes.size());
    for (const auto& [key, node] : nodes)
      table.push_back({std::string(key.str()), place_of(key.source(), name_), (*this)(node)});
    std::sort(table.begin(), table.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
    return table;
  }

  const std::string& name_;
};

/// toml++ limits how deep values are nested, but not the length of a dotted key, and such a key nests tables as deep:
/// the line of one that would exhaust the stack, 0 if there is none.
int line_of_endless_key(std::string_view text) {
  constexpr int most_dots = 200;
  int dots = 0;
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    if (c == '\n' || c == ',') dots = 0;
    if (c == '.' && ++dots > most_dots) return line;
  }
  return 0;
}

std::string complaint(const toml::parse_error& error) {
  std::string text(error.description());
  constexpr std::string_view prefix = "Error ";
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  return "not valid TOML: " + text;
}

/// The value that a text stands for on the command line.
Value override_value(const std::string& text, const std::string& key, const SourcePlace& place, Problems& problems) {
  Problems none;
  const auto as_value = parse_toml("value = " + text, place.file, none);
  const auto* const table = as_value ? as_value->as<Value::Table>() : nullptr;
  Value value;
  if (table != nullptr && table->size() == 1 && table->front().key == "value") {
    value = table->front().value;
  } else {
    value.content = text;
    if (!parse_toml("value = " + text_literal(text), place.file, none))
      problems.add(place, key, "its value is not valid UTF-8");
  }
  return value;
}

/// Everything inside an override counts as standing on the command line.
void set_places(Value& value, const SourcePlace& place) {
  value.place = place;
  if (auto* const list = value.as<Value::List>()) {
    for (auto& element : *list) set_places(element, place);
  } else if (auto* const table = value.as<Value::Table>()) {
    for (auto& entry : *table) {
      entry.place = place;
      set_places(entry.value, place);
    }
  }
}

}  // namespace

std::unique_ptr<Value> parse_toml(std::string_view text, const std::string& name, Problems& problems) {
  if (const int line = line_of_endless_key(text)) {
    problems.add({name, line, 1}, "", "this line has more than 200 dots in a row, too many for a key");
    return nullptr;
  }
  try {
    auto root = std::make_unique<Value>(Converter(name)(toml::parse(text, std::string_view(name))));
    root->place = {name, 1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    problems.add(place_of(error.source(), name), "", complaint(error));
    return nullptr;
  }
}

void apply_override(Value& root, const std::string& text, Problems& problems) {
  const SourcePlace place{"--set", 0, 0};
  const auto equals = text.find('=');
  const auto trimmed = [](std::string part) {
    part.erase(0, std::min(part.find_first_not_of(" \t"), part.size()));
    part.erase(part.find_last_not_of(" \t") + 1);
    return part;
  };
  const std::string key = trimmed(text.substr(0, equals));
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  const bool is_key = !key.empty() && key.find_first_not_of(letters) == std::string::npos && key.front() != '.' &&
                      key.back() != '.' && key.find("..") == std::string::npos && !line_of_endless_key(key);
  if (equals == std::string::npos || !is_key) {
    problems.add(place, "",
                 "must be a key and a value, such as physics.flow.viscosity=0.5, but is " + text_literal(text));
    return;
  }
  Value value = override_value(trimmed(text.substr(equals + 1)), key, place, problems);
  set_places(value, place);
  std::string obstacle;
  if (!root.set_path(key, std::move(value), &obstacle))
    problems.add(place, key, "cannot be set, since " + obstacle + " is no table");
}

namespace {

/// The file of a folder that is most likely its case: case.toml, or the only TOML file; empty if there is none.
std::string case_file_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (entry->path().filename() == "case.toml") return entry->path().string();
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  return files.size() == 1 ? files.front().string() : "";
}

}  // namespace

std::string read_text_file(const std::string& path, Problems& problems) {
  constexpr std::size_t most_bytes = std::size_t{4} << 20U;
  const auto refuse = [&](const std::string& why) {
    problems.add({path, 0, 0}, "", why);
    return std::string{};
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    const std::string inside = case_file_in(path);
    return refuse("cannot be read as a case: it is a folder; give " + (inside.empty() ? "a file (TOML)" : inside));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return refuse(std::string("cannot be read: ") + std::strerror(errno));
  std::string text(most_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return refuse(std::string("cannot be read: ") + std::strerror(errno));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > most_bytes) return refuse("cannot be read as a case: it is larger than 4 MiB");
  return text;
}

}  // namespace mesogen
