#include "case/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace mesogen {

namespace {

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
  return bare ? std::string(key) : text_literal(key);
}

struct InlineWriter {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const { return text_literal(value); }
  std::string operator()(const Value::Date& value) const { return value.text; }
  std::string operator()(const Value::List& list) const {
    std::string text;
    for (const auto& element : list) text += (text.empty() ? "" : ", ") + inline_text(element);
    return "[" + text + "]";
  }
  std::string operator()(const Value::Table& table) const {
    std::string text;
    for (const auto& entry : table)
      text += (text.empty() ? " " : ", ") + key_text(entry.key) + " = " + inline_text(entry.value);
    return text.empty() ? "{}" : "{" + text + " }";
  }
};

bool is_list_of_lists(const Value::List& list) {
  return !list.empty() &&
         std::all_of(list.begin(), list.end(), [](const Value& row) { return row.as<Value::List>() != nullptr; });
}

/// Holds named tables and nothing else, such as [physics]: has no header of its own.
bool is_group(const Value::Table& table) {
  return !table.empty() && std::all_of(table.begin(), table.end(),
                                       [](const Entry& entry) { return entry.value.as<Value::Table>() != nullptr; });
}

std::string entry_text(const Entry& entry) {
  std::string text = key_text(entry.key) + " = ";
  const auto* const list = entry.value.as<Value::List>();
  if (list == nullptr || list->size() < 2 || !is_list_of_lists(*list)) return text + inline_text(entry.value) + "\n";
  text += "[\n";
  for (const auto& row : *list) text += "  " + inline_text(row) + ",\n";
  return text + "]\n";
}

void write_section(const std::string& header, const Value::Table& table, std::string& text) {
  text += (text.empty() ? "[" : "\n[") + header + "]\n";
  for (const auto& entry : table) text += entry_text(entry);
}

}  // namespace

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string text_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    switch (c) {
      case '"': result += "\\\""; break;
      case '\\': result += "\\\\"; break;
      case '\n': result += "\\n"; break;
      case '\t': result += "\\t"; break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        result += code < 0x20 || code == 0x7f ? fmt::format("\\u{:04X}", code) : std::string(1, c);
      }
    }
  }
  return result + "\"";
}

std::string inline_text(const Value& value) { return std::visit(InlineWriter{}, value.content); }

std::string shown(const Value& value) {
  constexpr std::size_t longest = 60;
  if (value.as<Value::Table>() != nullptr) return "a table";
  std::string text = inline_text(value);
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a UTF-8 character
  return text.substr(0, end) + "...";
}

std::string document_text(const Value& root) {
  std::string text;
  const auto* const sections = root.as<Value::Table>();
  if (sections == nullptr) return text;
  for (const auto& entry : *sections)
    if (entry.value.as<Value::Table>() == nullptr) text += entry_text(entry);
  for (const auto& entry : *sections) {
    const auto* const table = entry.value.as<Value::Table>();
    if (table == nullptr) continue;
    const std::string header = key_text(entry.key);
    if (is_group(*table)) {
      for (const auto& inner : *table)
        write_section(header + "." + key_text(inner.key), *inner.value.as<Value::Table>(), text);
    } else {
      write_section(header, *table, text);
    }
  }
  return text;
}

}  // namespace mesogen
