#pragma once

#include "exec/reductions.hpp"
#include "particles/components.hpp"
#include "particles/field_loops.hpp"

/// How a step changes fields and moves particles.
namespace mesogen::exec {

/// Where somebody looks, it raises two: the squares of the value and of the rate.
template <class Real, int Components>
struct AdvanceField {
  AdvanceArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Maxima<2> nobody_looks{};
    (*this)(i, nobody_looks);
  }
  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<2>& largest) const {
    double value_square = 0.0;
    double rate_square = 0.0;
    for (int c = 0; c < Components; ++c) {
      const auto slope = static_cast<double>(a.rate(c, i));
      const double value = a.from(c, i) + a.by * slope;
      a.exact(c, i) = value;
      a.rounded(c, i) = static_cast<Real>(value);
      value_square += value * value;
      rate_square += slope * slope;
    }
    largest.raise(0, value_square);
    largest.raise(1, rate_square);
  }
};

/// The square of the way from where a particle was sorted; where that is not given 0, or not a number.
template <int Dim>
MESOGEN_HOST_DEVICE inline double square_of_way(const double (&at)[Dim], const double* const (&sorted)[3], Index i) {
  double square = 0.0;
  for (int d = 0; d < Dim; ++d) {
    const double way = at[d] - (sorted[d] != nullptr ? sorted[d][i] : at[d]);
    square += way * way;
  }
  return square;
}

/// Where somebody looks, it raises the square of how far the particle is from where it was sorted.
template <class Real, int Dim>
struct Move {
  MoveArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Maxima<1> nobody_looks{};
    (*this)(i, nobody_looks);
  }
  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& farthest) const {
    double at[Dim];
    for (int d = 0; d < Dim; ++d) {
      at[d] = m.position[d][i] + m.by * m.velocity(d, i) +
              (m.shift ? m.shift_by * static_cast<double>(m.shift(d, i)) : 0.0);
      m.position[d][i] = at[d];
    }
    farthest.raise(0, square_of_way(at, m.sorted, i));
  }
};

template <class Real, int Dim, bool ToMidpoint>
struct MoveByPasses {
  MoveByPassesArguments<Real> m;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Maxima<1> nobody_looks{};
    (*this)(i, nobody_looks);
  }
  MESOGEN_HOST_DEVICE void operator()(Index i, Maxima<1>& farthest) const {
    double at[Dim];
    for (int d = 0; d < Dim; ++d) {
      double by = 0.0;
      if constexpr (ToMidpoint) {
        by = m.step_size / 2.0 * static_cast<double>(m.velocity(d, i));
        m.way(d, i) = by;
      } else {
        const double speed =
            static_cast<double>(m.velocity(d, i)) + (m.shift ? static_cast<double>(m.shift(d, i)) : 0.0);
        by = m.step_size * speed - m.way(d, i);
      }
      at[d] = m.position[d][i] + by;
      m.position[d][i] = at[d];
    }
    farthest.raise(0, square_of_way(at, m.sorted, i));
  }
};

/// Calls action(move) with the functor that does it.
template <class Real, class Action>
auto with_move(const MoveArguments<Real>& arguments, const Action& action) {
  return compiled_for<1, 2, 3>(arguments.dimension, [&]<int Dim>() { return action(Move<Real, Dim>{arguments}); });
}
template <class Real, class Action>
auto with_move(const MoveByPassesArguments<Real>& arguments, const Action& action) {
  return compiled_for<2, 3>(arguments.dimension, [&]<int Dim>() {
    return arguments.to_midpoint ? action(MoveByPasses<Real, Dim, true>{arguments})
                                 : action(MoveByPasses<Real, Dim, false>{arguments});
  });
}

template <class Real, int Components>
struct Add {
  AddArguments<Real> a;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < Components; ++c) {
      const double value = a.exact(c, i) + a.by[c];
      a.exact(c, i) = value;
      a.rounded(c, i) = static_cast<Real>(value);
    }
  }
};

/// The sum of every n-th number, beginning with the i-th: threads that run together read numbers that lie together.
struct PartialSum {
  const double* values;
  Index count;
  Index n;
  double* sums;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    double sum = 0.0;
    for (std::ptrdiff_t at = i; at < count; at += n) sum += values[at];
    sums[i] = sum;
  }
};

}  // namespace mesogen::exec
