#include "case/units.hpp"

#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

/// Exponents of force, length and time, in the order in which they are written.
using Exponents = std::array<int, 3>;

std::optional<Exponents> symbol(std::string_view name) {
  struct Symbol {
    std::string_view name;
    Exponents exponents;
  };
  constexpr Symbol all[] = {{"1", {0, 0, 0}},   {"m", {0, 1, 0}},   {"s", {0, 0, 1}}, {"N", {1, 0, 0}},
                            {"kg", {1, -1, 2}}, {"Pa", {1, -2, 0}}, {"J", {1, 1, 0}}};
  for (const Symbol& one : all)
    if (one.name == name) return one.exponents;
  return std::nullopt;
}

/// Reads "kg/(m3 s)", "Pa m6/kg2", "kg/m^3": factors side by side; after a slash one factor or a bracket.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::optional<Exponents> read() {
    Exponents all{};
    if (!product(all, 1) || at_ != text_.size() || !factors_) return std::nullopt;
    return all;
  }

 private:
  [[nodiscard]] bool more() const { return at_ < text_.size(); }
  bool take(char c) {
    if (!more() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool product(Exponents& all, int sign) {
    while (more() && text_[at_] != ')') {
      if (take(' ')) continue;
      const int power = take('/') ? -sign : sign;
      if (take('(')) {
        if (!product(all, power) || !take(')')) return false;
      } else if (!factor(all, power)) {
        return false;
      }
    }
    return true;
  }

  bool factor(Exponents& all, int sign) {
    const std::size_t begin = at_;
    while (more() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    if (at_ == begin && !take('1')) return false;
    const auto exponents = symbol(text_.substr(begin, at_ - begin));
    if (!exponents) return false;
    take('^');
    int power = 0;
    while (more() && std::isdigit(static_cast<unsigned char>(text_[at_])) != 0)
      power = 10 * power + (text_[at_++] - '0');
    for (std::size_t n = 0; n < all.size(); ++n) all[n] += sign * (power == 0 ? 1 : power) * (*exponents)[n];
    factors_ = true;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool factors_ = false;
};

std::string written(const Exponents& exponents, const Units& units) {
  const std::array<std::string, 3> names = {units.force, units.length, units.time};
  std::string above;
  std::string below;
  int divisors = 0;
  for (std::size_t n = 0; n < names.size(); ++n) {
    const int power = exponents[n];
    if (power == 0) continue;
    std::string& side = power > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += names[n];
    if (std::abs(power) > 1) side += std::to_string(std::abs(power));
    if (power < 0) ++divisors;
  }
  if (divisors == 0) return above.empty() ? "1" : above;
  return (above.empty() ? "1" : above) + "/" + (divisors > 1 ? "(" + below + ")" : below);
}

}  // namespace

std::string Units::text(std::string_view declared) const {
  if (si()) return std::string(declared);
  if (const auto comma = declared.find(", "); comma != std::string_view::npos)
    return text(declared.substr(0, comma)) + ", " + text(declared.substr(comma + 2));
  const auto exponents = Reader(declared).read();
  return exponents ? written(*exponents, *this) : std::string(declared);
}

std::string Units::time_text(double seconds) const { return rounded_text(seconds) + " " + time; }

}  // namespace mesogen
