#pragma once

#include <cmath>

namespace mesogen::exec {

/// A sum in double precision whose rounding error does not grow with the number of terms (Neumaier, ZAMM 54, 39, 1974).
/// For sums whose terms cancel, such as the total momentum of a fluid that is at rest as a whole.
class CompensatedSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace mesogen::exec
