#include "case/problems.hpp"

#include <algorithm>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

std::string SourcePlace::text() const {
  return line > 0 ? file + ":" + std::to_string(line) + ":" + std::to_string(column) : file;
}

void Problems::add(const SourcePlace& place, const std::string& key, const std::string& text) {
  std::string line = place.text() + ": " + (key.empty() ? "" : key + ": ") + text;
  // Names in a broken file may hold anything; a terminal must not act on them.
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  lines_.push_back(std::move(line));
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
