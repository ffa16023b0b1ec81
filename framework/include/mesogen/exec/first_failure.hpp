#pragma once

#include <exception>

namespace mesogen::exec {

/// Carries an exception out of a parallel region, which an exception must not leave by itself. Keeps the first
/// exception of any thread. Costs nothing where the compiler sees that nothing throws.
class FirstFailure {
 public:
  /// Call it in catch (...); any thread may.
  void keep() noexcept {
#pragma omp critical(mesogen_first_failure)
    if (!failure_) failure_ = std::current_exception();
  }
  /// Call it after the parallel region: throws the exception that was kept, if any.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr failure_;
};

}  // namespace mesogen::exec
