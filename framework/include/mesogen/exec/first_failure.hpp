#pragma once

#include <exception>

namespace mesogen::exec {

/// Carries an exception out of a parallel region, which it must not leave by itself: the first one that any thread
/// keeps. Costs nothing where the compiler sees that nothing is thrown.
class FirstFailure {
 public:
  /// To be called in catch (...), by any thread.
  void keep() noexcept {
#pragma omp critical(mesogen_first_failure)
    if (!failure_) failure_ = std::current_exception();
  }
  /// After the region.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr failure_;
};

}  // namespace mesogen::exec
