#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "mesogen/export.hpp"

namespace mesogen {

/// Wall time by name, summed over a run.
class MESOGEN_EXPORT Timers {
 public:
  struct Total {
    double seconds = 0.0;
    std::int64_t count = 0;
  };
  /// Adds the time from its making to its end.
  class MESOGEN_EXPORT Scope {
   public:
    explicit Scope(Total& total) : total_(total), begin_(std::chrono::steady_clock::now()) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope();

   private:
    Total& total_;
    std::chrono::steady_clock::time_point begin_;
  };

  /// `const auto timed = timers.measure("sort");`
  [[nodiscard]] Scope measure(std::string_view name) { return Scope(total(name)); }
  void add(std::string_view name, double seconds);
  void clear() { totals_.clear(); }
  [[nodiscard]] const std::map<std::string, Total, std::less<>>& totals() const { return totals_; }
  /// One line a name, the longest first: seconds, share of `whole_seconds`, count, time a call.
  [[nodiscard]] std::string text(double whole_seconds) const;

 private:
  Total& total(std::string_view name);
  std::map<std::string, Total, std::less<>> totals_;
};

}  // namespace mesogen
