#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesogen/export.hpp"

/// Where the time of a run goes: counters of what each piece of work took in all, which `run --profile` prints, and a
/// trace of each time that it was done, which `run --trace` writes. One `Span` around the work serves both.
namespace mesogen {

/// How often a piece of work was done, and how long it took in all.
struct Counter {
  std::string title;                   ///< "physics.flow: momentum"
  const char* category = "framework";  ///< whose work it is: "plugin", "framework" or "output"
  std::int64_t runs = 0;
  double seconds = 0.0;
};

/// Each time that a piece of work was done, up to a number that bounds memory. Its room is taken once, so that a step
/// allocates nothing.
class MESOGEN_EXPORT Trace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t usual_most = 500'000;  ///< 16 MB of memory, some 70 MB of text

  explicit Trace(std::size_t most = usual_most);

  /// The counter must outlive the trace. What comes after the last that there is room for is counted alone.
  void record(const Counter& counter, Clock::time_point begun, Clock::time_point ended);
  [[nodiscard]] std::size_t recorded() const { return events_.size(); }
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }

  /// The trace as JSON in the Trace Event Format (Duffy and others, "Trace Event Format", 2016): complete events by
  /// their start, in microseconds since the trace began; what was done inside another stands behind it. Perfetto and
  /// chrome://tracing read it.
  [[nodiscard]] std::string text() const;

 private:
  struct Event {
    const Counter* counter;
    std::int64_t run;  // the how-many-th of this counter, from 1
    Clock::time_point begun;
    Clock::time_point ended;
  };

  Clock::time_point origin_ = Clock::now();
  std::size_t most_;
  std::vector<Event> events_;
  std::int64_t left_out_ = 0;
};

/// From here to the end of the scope a piece of work is done, also if it ends by throwing. Spans lie within each other;
/// they belong to the thread that steps.
class Span {
 public:
  /// `trace`: null where none is asked for.
  Span(Counter& counter, Trace* trace) : counter_(counter), trace_(trace), begun_(Trace::Clock::now()) {}
  Span(const Span&) = delete;
  Span& operator=(const Span&) = delete;
  ~Span() {
    const auto ended = Trace::Clock::now();
    ++counter_.runs;
    counter_.seconds += std::chrono::duration<double>(ended - begun_).count();
    if (trace_ != nullptr) trace_->record(counter_, begun_, ended);
  }

 private:
  Counter& counter_;
  Trace* trace_;
  Trace::Clock::time_point begun_;
};

}  // namespace mesogen
