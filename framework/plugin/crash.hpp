#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "mesogen/export.hpp"

namespace mesogen {

/// From now on, a signal that ends this process because of what its code did (SIGSEGV, SIGBUS, SIGFPE, SIGILL,
/// SIGABRT), SIGALRM, and exit() called within a plugin, write to `file` which call into which plugin was under way,
/// and, in a run, how to go on. The signal then does what it would have done: exit status and core dump stay as they
/// are. After exit() the status is 1, since nothing was completed. In a build with a sanitizer that reports such
/// signals itself, the line comes after its report.
///
/// To be called by the main thread, which makes the calls; a crash in a thread of a parallel loop is told with the call
/// that the main thread is in.
MESOGEN_EXPORT void tell_of_crashes(int file);

/// For a thread that works beside the main thread: its crash has nothing to do with the call that the main thread is
/// in.
MESOGEN_EXPORT void tell_of_crashes_in_this_thread();

/// Lets the threads of the next parallel loops tell of an overflow of their own stacks too. Does nothing before
/// tell_of_crashes.
MESOGEN_EXPORT void tell_of_crashes_in_threads();

/// What a crash of a run is told with: the moment, and how to go on. One at a time.
class MESOGEN_EXPORT CrashAdvice {
 public:
  /// Step and time must outlive it.
  CrashAdvice(const std::int64_t& step, const double& time, std::string time_unit = "s");
  ~CrashAdvice();
  CrashAdvice(const CrashAdvice&) = delete;
  CrashAdvice& operator=(const CrashAdvice&) = delete;

  /// A sentence, in place of the one before.
  void advise(std::string text);

  const std::int64_t& step;
  const double& time;
  const std::string time_unit;
  /// The sentence; empty if there is none.
  [[nodiscard]] const char* text() const { return texts_[current_.load()].c_str(); }

 private:
  // A crash while one is written finds the other.
  std::array<std::string, 2> texts_;
  std::atomic<std::size_t> current_{0};
};

}  // namespace mesogen
