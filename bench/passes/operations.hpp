#pragma once

// How many floating-point operations does a pass do a pair? Passes are written over any lane, so here the lane is a
// number that counts: additions, multiplications, maxima and comparisons one each, a fused pair two, sqrt(x) and
// 1 / sqrt(x) together nine (estimate and Newton's iteration). To be included before all else of the framework: it adds
// to the operations that passes find there.

#include "mesogen/exec/lanes.hpp"

namespace mesogen::bench {

class Counted {
 public:
  Counted() = default;
  explicit Counted(double) {}

  // There is nowhere else for an operator to count.
  static inline int operations = 0;
  static Counted result(int added) {
    operations += added;
    return {};
  }

  friend Counted operator+(Counted, Counted) { return result(1); }
  friend Counted operator-(Counted, Counted) { return result(1); }
  friend Counted operator*(Counted, Counted) { return result(1); }
  friend Counted operator/(Counted, Counted) { return result(1); }
  friend Counted operator+(Counted, double) { return result(1); }
  friend Counted operator*(Counted, double) { return result(1); }
};

}  // namespace mesogen::bench

namespace mesogen::exec {

inline void load(const double*, bench::Counted&) {}
inline bench::Counted positive_part(bench::Counted) { return bench::Counted::result(1); }
inline void find_roots(bench::Counted, bench::Counted& root, bench::Counted& inverse) {
  root = bench::Counted::result(3);
  inverse = bench::Counted::result(6);
}
/// Among those of `find_roots`, which every pair is counted with.
inline bench::Counted find_root(bench::Counted) { return {}; }
inline bench::Counted add_where_less(bench::Counted, bench::Counted, bench::Counted, bench::Counted) {
  return bench::Counted::result(2);
}
inline bench::Counted where_less(bench::Counted, bench::Counted, bench::Counted) { return bench::Counted::result(1); }

}  // namespace mesogen::exec

#include "mesogen/sph/kernel_function.hpp"
#include "mesogen/sph/pairs.hpp"

namespace mesogen::bench {

/// Operations that a pass does at one pair, the pair's own among them: separation, distance, kernel.
template <class Pass>
int operations(const sph::SmoothingKernel& kernel, const Pass& pass) {
  int found = 0;
  sph::with_kernel_function<double>(kernel, [&](const auto& function) {
    using Kernel = std::decay_t<decltype(function)>;
    Counted sum[Pass::sum_count];
    const double place[1] = {};
    Neighbours<double, 2> neighbours{};
    neighbours.local[0] = neighbours.local[1] = place;
    const Counted at[2];
    Counted::operations = 0;
    const sph::Pair<double, 2, Counted, Kernel> pair(neighbours, function, {0}, at, Counted());
    pass.pair(typename Pass::Own{}, pair, &sum[0]);
    found = Counted::operations;
  });
  return found;
}

}  // namespace mesogen::bench
