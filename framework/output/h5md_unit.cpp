#include "output/h5md_unit.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <utility>
#include <vector>

namespace mesogen::output {

namespace {

// Bureau international des poids et mesures, The International System of Units, 9th edition (2019), tables 2, 4 and 7,
// with the ASCII symbols of the units module.
constexpr std::array symbols = {"m",  "g",  "s",  "A",  "K",  "mol", "cd", "rad", "sr",  "Hz",
                                "N",  "Pa", "J",  "W",  "C",  "V",   "F",  "S",   "T",   "ohm",
                                "Wb", "H",  "lm", "lx", "Bq", "Gy",  "Sv", "kat", "degC"};
constexpr std::array prefixes = {"", "E", "P", "T", "G", "M", "k", "h", "da", "d", "c", "m", "u", "n", "p", "f", "a"};

bool is_si(std::string_view symbol) {
  return std::ranges::any_of(prefixes, [&](std::string_view prefix) {
    return symbol.starts_with(prefix) && std::ranges::find(symbols, symbol.substr(prefix.size())) != symbols.end();
  });
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads  product = factor { [" " | "/"] factor },  factor = number | symbol [["^"] power] | "(" product ")".
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : rest_(text) {}

  bool read() { return product(1) && rest_.empty(); }

  [[nodiscard]] std::string spelled() const {
    std::string text = number_;
    for (const auto& [symbol, power] : powers_) {
      if (power == 0) continue;
      text += (text.empty() ? "" : " ") + symbol;
      if (power != 1) text += (power > 0 ? "+" : "") + std::to_string(power);
    }
    return text.empty() ? "1" : text;
  }

 private:
  bool product(int sign) {
    int direction = sign;
    do {
      if (!factor(direction)) return false;
      direction = sign;
      skip_spaces();
      if (take('/')) {
        direction = -sign;
        skip_spaces();
      }
    } while (direction != sign || (!rest_.empty() && rest_.front() != ')'));
    return true;
  }

  bool factor(int sign) {
    if (take('(')) return product(sign) && take(')');
    if (rest_.empty()) return false;
    return is_digit(rest_.front()) ? number(sign) : symbol(sign);
  }

  /// Only 1 can be divided by, and only the first factor can be another number.
  bool number(int sign) {
    const std::string_view digits = take_while([](char c) { return is_digit(c) || c == '.'; });
    if (digits == "1") return true;
    if (sign < 0 || !number_.empty() || !powers_.empty()) return false;
    number_ = digits;
    if (!rest_.empty() && (rest_[0] == '+' || rest_[0] == '-')) {
      const auto power = integer();
      if (!power) return false;
      number_ += (*power < 0 ? "" : "+") + std::to_string(*power);
    }
    return true;
  }

  bool symbol(int sign) {
    const std::string name(take_while(is_letter));
    if (!is_si(name)) return false;
    const bool raised = take('^');
    const bool has_sign = !rest_.empty() && (rest_[0] == '+' || rest_[0] == '-');
    int power = 1;
    if (raised || has_sign || (!rest_.empty() && is_digit(rest_[0]))) {
      const auto given = integer();
      if (!given) return false;
      power = *given;
    }
    const auto at = std::ranges::find(powers_, name, &Power::first);
    if (at == powers_.end())
      powers_.emplace_back(name, sign * power);
    else
      at->second += sign * power;
    return true;
  }

  /// 3, +3 or -3; of a few digits.
  std::optional<int> integer() {
    const int sign = take('-') ? -1 : 1;
    if (sign > 0) take('+');
    const std::string_view digits = take_while(is_digit);
    if (digits.empty() || digits.size() > 3) return {};
    int power = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), power);
    return sign * power;
  }

  void skip_spaces() {
    while (take(' ')) {
    }
  }
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  template <class Wanted>
  std::string_view take_while(const Wanted& wanted) {
    const auto end = std::ranges::find_if_not(rest_, wanted);
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  using Power = std::pair<std::string, int>;
  std::string_view rest_;
  std::string number_;
  std::vector<Power> powers_;  // in the order of their first appearance; each symbol may stand only once
};

}  // namespace

std::optional<std::string> h5md_unit(std::string_view text) {
  UnitReader reader(text);
  if (!reader.read()) return {};
  return reader.spelled();
}

}  // namespace mesogen::output
