#include "mesogen/exec/exact_sum.hpp"

#include <cmath>

namespace mesogen::exec {

namespace {

constexpr int bits = 32;                              // of a digit
constexpr int lowest = -1088;                         // digit k counts units of 2^(lowest + 32 k); no double is finer
constexpr double too_large = 0x1p960;                 // to be cut into digits together
constexpr std::int64_t low_bits = (1LL << bits) - 1;  // of a digit

int exponent_of_unit(std::size_t digit) { return lowest + bits * static_cast<int>(digit); }

}  // namespace

void ExactSum::add(std::span<const double> terms) {
  constexpr std::size_t together = 256;
  for (; terms.size() > together; terms = terms.subspan(together)) add_some(terms.first(together));
  add_some(terms);
}

void ExactSum::add_some(std::span<const double> terms) {
  double rest[256];
  const std::size_t count = terms.size();
  double largest = 0.0;
  double check = 0.0;  // not a number if a term is infinite or none
#pragma omp simd reduction(max : largest) reduction(+ : check)
  for (std::size_t n = 0; n < count; ++n) {
    rest[n] = terms[n];
    largest = std::abs(rest[n]) > largest ? std::abs(rest[n]) : largest;
    check += rest[n] - rest[n];
  }
  if (std::isnan(check) || largest >= too_large) {
    for (const double term : terms) add(term);
    return;
  }
  // Adding and taking away `shift` rounds to a multiple of the digit's unit: nothing but the smaller rest is lost, and
  // that goes on to the next digit. The sum of the multiples has fewer than 53 bits, so it is exact in any order.
  while (largest > 0.0) {
    const auto k = static_cast<std::size_t>((std::ilogb(largest) - lowest) / bits);
    const double shift = std::ldexp(1.5, exponent_of_unit(k) + 52);
    double sum = 0.0;
    largest = 0.0;
#pragma omp simd reduction(max : largest) reduction(+ : sum)
    for (std::size_t n = 0; n < count; ++n) {
      const double multiple = (rest[n] + shift) - shift;
      rest[n] -= multiple;
      sum += multiple;
      largest = std::abs(rest[n]) > largest ? std::abs(rest[n]) : largest;
    }
    digit_[k] += static_cast<std::int64_t>(std::ldexp(sum, -exponent_of_unit(k)));
  }
}

void ExactSum::add(double term) {
  if (!std::isfinite(term)) {
    not_finite_ += term;
    return;
  }
  int exponent = 0;
  auto integer = static_cast<std::int64_t>(std::ldexp(std::frexp(term, &exponent), 53));
  int at = exponent - 53 - lowest;  // in bits from the lowest unit
  if (at < 0) {                     // a subnormal number, whose last bits are 0
    integer >>= -at;
    at = 0;
  }
  const auto k = static_cast<std::size_t>(at / bits);
  const std::int64_t low = (integer & low_bits) << (at % bits);
  const std::int64_t high = (integer >> bits) * (1LL << (at % bits));
  digit_[k] += low & low_bits;
  digit_[k + 1] += (low >> bits) + (high & low_bits);
  digit_[k + 2] += high >> bits;
}

void ExactSum::add(const ExactSum& other) {
  for (std::size_t k = 0; k < digits; ++k) digit_[k] += other.digit_[k];
  not_finite_ += other.not_finite_;
}

double ExactSum::value() const {
  if (!(not_finite_ == 0.0)) return not_finite_;
  std::array<std::int64_t, digits> digit = digit_;
  // Carries make every digit but the last lie in [0, 2^32): one number then has one form. The last has the sign.
  const auto carry = [&digit] {
    for (std::size_t k = 0; k + 1 < digits; ++k) {
      digit[k + 1] += digit[k] >> bits;
      digit[k] &= low_bits;
    }
  };
  carry();
  const bool negative = digit[digits - 1] < 0;
  if (negative) {
    for (std::int64_t& part : digit) part = -part;
    carry();
  }
  double sum = 0.0;  // the smallest first: only the last additions round by much
  for (std::size_t k = 0; k < digits; ++k)
    if (digit[k] != 0) sum += std::ldexp(static_cast<double>(digit[k]), exponent_of_unit(k));
  return negative ? -sum : sum;
}

}  // namespace mesogen::exec
