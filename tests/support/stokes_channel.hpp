#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "case_run.hpp"

namespace mesogen::test {

/// A channel along x whose walls are at rest, with particles on a lattice.
struct Channel {
  std::size_t columns;  ///< particles along the channel
  double width;         ///< m
  double activity;      ///< Pa
  double viscosity;     ///< Pa s
};

struct Comparison {
  double amplitude;  ///< of the velocity, over that of Stokes flow
  double distance;   ///< root of the mean square difference, relative
};

/// The velocity, row by row, with mu u' = zeta (Q12 - <Q12>) of the run's own Q, u = 0 at both walls.
inline Comparison profile_beside_stokes(CaseRun& run, const Channel& channel) {
  const auto q12 = run.field("order_tensor", 1);
  const auto u = run.field("velocity", 0);
  const std::size_t columns = channel.columns;
  const std::size_t rows = q12.size() / columns;
  const auto mean_of = [](const std::vector<double>& values, std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += values[i];
    return sum / static_cast<double>(end - begin);
  };
  const double mean = mean_of(q12, 0, q12.size());
  const double step = channel.width / static_cast<double>(rows) * channel.activity / channel.viscosity;
  double face = 0.0;  // velocity at the lower face of a row
  double wrong = 0.0;
  double both = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < rows; ++n) {
    const double slope = mean_of(q12, n * columns, (n + 1) * columns) - mean;
    const double moved = mean_of(u, n * columns, (n + 1) * columns);
    const double exact = face + step / 2.0 * slope;
    face += step * slope;
    wrong += std::pow(moved - exact, 2);
    both += moved * exact;
    all += exact * exact;
  }
  return {both / all, std::sqrt(wrong / all)};
}

}  // namespace mesogen::test
