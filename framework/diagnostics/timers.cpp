#include "diagnostics/timers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mesogen {

Timers::Scope::~Scope() {
  total_.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  ++total_.count;
}

Timers::Total& Timers::total(std::string_view name) {
  const auto found = totals_.find(name);
  return found != totals_.end() ? found->second : totals_.emplace(std::string(name), Total{}).first->second;
}

void Timers::add(std::string_view name, double seconds) {
  auto& sum = total(name);
  sum.seconds += seconds;
  ++sum.count;
}

std::string Timers::text(double whole_seconds) const {
  std::vector<std::pair<std::string, Total>> rows(totals_.begin(), totals_.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
  std::size_t widest = 0;
  for (const auto& [name, sum] : rows) widest = std::max(widest, name.size());
  std::string text;
  for (const auto& [name, sum] : rows) {
    const double share = whole_seconds > 0.0 ? 100.0 * sum.seconds / whole_seconds : 0.0;
    const double each = sum.count > 0 ? 1e3 * sum.seconds / static_cast<double>(sum.count) : 0.0;
    text += fmt::format("{:<{}}  {:>9.3f} s  {:>5.1f} %  {:>8} x  {:>10.4f} ms\n", name, widest, sum.seconds, share,
                        sum.count, each);
  }
  return text;
}

}  // namespace mesogen
