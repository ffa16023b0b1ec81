#include "case/problems.hpp"

#include <algorithm>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

std::string SourcePlace::text() const {
  return line > 0 ? file + ":" + std::to_string(line) + ":" + std::to_string(column) : file;
}

namespace {

// Names in a broken file may hold anything; a terminal must not act on them.
std::string harmless(std::string line) {
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return line;
}

}  // namespace

void Problems::add(const SourcePlace& place, const std::string& key, const std::string& text) {
  lines_.push_back(harmless(place.text() + ": " + (key.empty() ? "" : key + ": ") + text));
}

void Problems::add_lines(const SourcePlace& place, std::string_view text) {
  std::string all = place.text() + ": ";
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    all += (from == 0 ? "" : "\n  ") + harmless(std::string(text.substr(from, end - from)));
    from = end + 1;
  }
  lines_.push_back(std::move(all));
}

std::string Problems::text() const {
  std::string all;
  for (const auto& line : lines_) all += (all.empty() ? "" : "\n") + line;
  return all;
}

void Problems::throw_if_any() const {
  if (!empty()) throw Error(ExitCode::bad_case, text());
}

}  // namespace mesogen
