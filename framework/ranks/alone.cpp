#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string_view>

#include "ranks/ranks.hpp"

namespace mesogen {

exec::Sharing::~Sharing() = default;

namespace {

class Alone final : public Ranks {
 public:
  [[nodiscard]] int rank() const override { return 0; }
  [[nodiscard]] int count() const override { return 1; }
  void largest(std::span<double>) const override {}
  void add(std::span<double>) const override {}
  void add(std::span<float>) const override {}
  void add(std::span<std::int64_t>) const override {}
  void broadcast(std::span<std::byte>) const override {}
  [[nodiscard]] std::vector<std::int64_t> swap(std::span<const std::int64_t> numbers) const override {
    return {numbers.begin(), numbers.end()};
  }
  void exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) const override {
    if (outgoing.size() != incoming.size()) throw std::logic_error("a message that nobody receives");
    for (std::size_t n = 0; n < outgoing.size(); ++n) {
      if (outgoing[n].bytes.size() != incoming[n].bytes.size()) throw std::logic_error("a message of another length");
      std::ranges::copy(outgoing[n].bytes, incoming[n].bytes.begin());
    }
  }
  [[noreturn]] void abort(int exit_status) const override { std::exit(exit_status); }
};

}  // namespace

Ranks::~Ranks() = default;

std::string text_of_worst(const Ranks& ranks, double number, const std::string& text) {
  if (!ranks.several()) return text;
  double worst = number;
  ranks.largest(std::span(&worst, 1));
  double first = number == worst ? 1.0 / (1.0 + ranks.rank()) : 0.0;
  const double own = first;
  ranks.largest(std::span(&first, 1));
  const std::string_view said = own == first ? std::string_view(text) : std::string_view();
  std::vector<char> all = gather(ranks, std::span<const char>(said));
  std::int64_t length = ranks.is_first() ? static_cast<std::int64_t>(all.size()) : 0;
  ranks.add(std::span(&length, 1));
  all.resize(static_cast<std::size_t>(length));
  ranks.broadcast(std::as_writable_bytes(std::span(all)));
  return {all.begin(), all.end()};
}

bool same_on_all(const Ranks& ranks, const std::string& text) {
  if (!ranks.several()) return true;
  const auto hash = static_cast<double>(std::hash<std::string>()(text) >> 12U);  // exact in a double
  std::array extremes{hash, 0x1p52 - hash};
  ranks.largest(extremes);
  return !any(ranks, extremes[0] != hash || extremes[1] != 0x1p52 - hash);
}

const Ranks& Ranks::alone() {
  static const Alone one;
  return one;
}

}  // namespace mesogen
