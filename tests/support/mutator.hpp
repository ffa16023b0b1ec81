#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

namespace mesogen::test {

/// Breaks a text as editors, disks and hurried people do; seeded, so that a failure can be found again.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  std::string mutated(std::string text) {
    for (std::size_t count = 1 + below(4); count > 0; --count) mutate(text);
    return text;
  }

 private:
  void mutate(std::string& text) {
    const std::array<std::string, 16> pieces = {"nan", "-inf",  "[",   "]",     "{",  "}",      "\"",   "=",
                                                ".",   "[[x]]", "1e9", "\n\n#", "\t", "\"\"\"", "0x7f", "1979-05-27"};
    const std::size_t at = below(text.size() + 1);
    switch (below(6)) {
      case 0: text.erase(at, 1 + below(12)); break;
      case 1: text.insert(at, pieces.at(below(pieces.size()))); break;
      case 2: text.insert(at, 1, static_cast<char>(below(256))); break;
      case 3: text.resize(at); break;
      case 4: text.insert(below(text.size() + 1), text.substr(at, below(40))); break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(7)));
    }
  }
  std::size_t below(std::size_t count) { return random_() % count; }

  std::mt19937 random_;
};

}  // namespace mesogen::test
