#include "text/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace mesogen {

namespace {

std::string lower(std::string_view word) {
  std::string result(word);
  for (auto& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Insertions, deletions, replacements and swaps of neighbours between two words (Damerau-Levenshtein, each letter
/// edited once).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 80;  // what is longer is no misspelt name, and would cost time
  if (word.empty() || word.size() > longest) return {};
  const std::string given = lower(word);
  const std::size_t allowed = (given.size() + 1) / 3;
  std::string best;
  std::size_t least = allowed + 1;
  for (const auto& candidate : candidates) {
    const std::string name = lower(candidate);
    if (name.size() > longest) continue;
    std::size_t edits = distance(given, name);
    // "periodik" means "periodic_ghosts" though much is missing at its end
    if (given.size() >= 4 && name.size() > given.size())
      edits = std::min(edits, distance(given, std::string_view(name).substr(0, given.size())) + 1);
    if (edits < least) {
      least = edits;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string candidate = nearest(word, candidates);
  return candidate.empty() ? "" : "; did you mean \"" + candidate + "\"?";
}

}  // namespace mesogen
