#pragma once

#include <vector>

#include "mesogen/domain/neighbours.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/kernel_function.hpp"

/// Sums over neighbours. A pass is a small struct, written once for every lane type and for host and device:
///
///     struct MyPass {
///       static constexpr int sum_count = 2;                  // how many numbers it adds up
///       FieldView<const Real> volume, value;                 // what it reads
///       FieldView<Real> result;                              // what it writes
///       struct Own { Real value; };                          // what it needs of particle i at every pair
///       Own load(Index i) const;
///       template <class Pair, class Lane>
///       void pair(const Own& own, const Pair& p, Lane* sum) const;   // add one pair (a lane of pairs)
///       void finish(Index i, const Own& own, const Real* sum) const; // store the result
///     };
///
/// The pair (i, i) is visited too, with separation exactly zero.
namespace mesogen::sph {

/// One pair, or one pack of pairs (i, j), (i, j + 1), ... What a pass does not ask for is not computed.
template <class Real, int Dim, class LaneType, class Kernel>
struct Pair {
  using Lane = LaneType;

  Lane separation[Dim];   ///< r_i - r_j, m
  Lane distance;          ///< |r_i - r_j|, m; never exactly zero
  Lane inverse_distance;  ///< 1 / distance, 1/m
  const Kernel& kernel;
  Real radius;
  Index j;

  /// Value of a field at j.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane load(const FieldView<const Real>& field, int component = 0) const {
    return load_from(field.base + component * field.stride + j);
  }
  /// W(r_ij), 1/m^Dim.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value() const { return kernel.value(distance); }
  /// W'(r_ij) / r_ij: times the separation it is the gradient of W with respect to r_i. 1/m^(Dim + 2), negative.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane gradient() const {
    return kernel.derivative(distance) * inverse_distance;
  }
  /// The given lane where j is within the support, zero elsewhere: for sums that the kernel does not weight.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane inside(const Lane& x) const {
    return exec::where_less(distance, Lane(radius), x);
  }

 private:
  friend struct PairLoop;
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE static Lane load_from(const Real* from) {
#ifdef __CUDACC__
    return *from;
#else
    if constexpr (requires { Lane::size(); }) {
      Lane lane;
      lane.copy_from(from, exec::stdx::element_aligned);
      return lane;
    } else {
      return *from;
    }
#endif
  }

 public:
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Pair(const Neighbours<Real, Dim>& n, const Kernel& k, Index first,
                                                  const Real (&at)[Dim], const Lane& excess)
      : kernel(k), radius(n.radius), j(first) {
    Lane square(n.smallest);
    exec::unroll<Dim>([&](auto d) {
      separation[d] = Lane(at[d]) - load_from(n.local[d] + first);
      square = separation[d] * separation[d] + square;
    });
    square = square + excess;
    inverse_distance = exec::inverse_square_root(square);
    distance = square * inverse_distance;
  }
};

#ifdef __CUDACC__

/// One thread a particle.
template <class Real, int Dim, class Kernel, class Pass>
struct PairSumOfParticle {
  Neighbours<Real, Dim> neighbours;
  Kernel kernel;
  Pass pass;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    int at[Dim];
    neighbours.cell_coordinates(neighbours.cell_of[i], at);
    Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
    const int count = neighbours.segments(at, segment);
    const auto own = pass.load(i);
    Real sums[Pass::sum_count] = {};
    for (int s = 0; s < count; ++s) {
      Real position[Dim];
      for (int d = 0; d < Dim; ++d) position[d] = neighbours.local[d][i] - segment[s].offset[d];
      for (Index j = segment[s].begin; j < segment[s].end; ++j)
        pass.pair(own, Pair<Real, Dim, Real, Kernel>(neighbours, kernel, j, position, Real(0)), sums);
    }
    pass.finish(i, own, sums);
  }
};

#else

/// The neighbours of a cell cut into packs: one loop of known length a particle, the same for all particles of the
/// cell.
template <class Real, int Dim, int Width>
struct NeighbourBlocks {
  struct Block {
    Index first;
    Real offset[Dim];
    const Real* excess;  ///< added to the squared distances of a pack
  };
  // Lanes past the end of a segment hold other particles, in the coordinates of another tile: moved out of reach.
  Real window[2 * Width];
  std::vector<Block> blocks;

  explicit NeighbourBlocks(Real radius) {
    for (int lane = 0; lane < Width; ++lane) {
      window[lane] = Real(0);
      window[Width + lane] = Real(16) * radius * radius;
    }
    blocks.reserve(64);
  }

  /// Blocks point into this object's window.
  NeighbourBlocks(const NeighbourBlocks&) = delete;
  NeighbourBlocks& operator=(const NeighbourBlocks&) = delete;

  void look_from(const Neighbours<Real, Dim>& neighbours, const int (&at)[Dim]) {
    blocks.clear();
    Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
    const int segments = neighbours.segments(at, segment);
    for (int n = 0; n < segments; ++n) {
      for (Index j = segment[n].begin; j < segment[n].end; j += Width) {
        Block& b = blocks.emplace_back();
        b.first = j;
        for (int d = 0; d < Dim; ++d) b.offset[d] = segment[n].offset[d];
        const Index left = segment[n].end - j;
        b.excess = window + (left < Width ? Width - left : 0);
      }
    }
  }
};

/// All particles of one cell, a SIMD pack of neighbours at a time; the sums stay in registers over all segments of a
/// particle and are reduced once.
template <class Real, int Dim, class Kernel, class Pass>
void pair_sums_of_cell(const Neighbours<Real, Dim>& neighbours, const Kernel& kernel, const Pass& pass, int cell,
                       NeighbourBlocks<Real, Dim, static_cast<int>(exec::Pack<Real>::size())>& seen) {
  using Lane = exec::Pack<Real>;
  int at[Dim];
  neighbours.cell_coordinates(cell, at);
  const int index = neighbours.cell_index(at);
  const Index first = neighbours.cell_begin[index];
  const Index last = neighbours.cell_end[index];
  if (first == last) return;
  seen.look_from(neighbours, at);
  for (Index i = first; i < last; ++i) {
    const auto own = pass.load(i);
    Lane sums[Pass::sum_count];
    exec::unroll<Pass::sum_count>([&](auto n) { sums[n] = Lane(Real(0)); });
    for (const auto& block : seen.blocks) {
      Real position[Dim];
      for (int d = 0; d < Dim; ++d) position[d] = neighbours.local[d][i] - block.offset[d];
      Lane excess;
      excess.copy_from(block.excess, exec::stdx::element_aligned);
      pass.pair(own, Pair<Real, Dim, Lane, Kernel>(neighbours, kernel, block.first, position, excess), &sums[0]);
    }
    Real total[Pass::sum_count];
    exec::sum_lanes(sums, total);
    pass.finish(i, own, total);
  }
}

#endif

/// Runs a pass with one kernel function over every particle of the box. The order of summation is the order of storage:
/// results do not depend on the number of threads.
template <class Real, int Dim, class Kernel, class Pass>
void pair_sum_with(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const Kernel& function,
                   const Pass& pass) {
#ifdef __CUDACC__
  exec::for_each(space, neighbours.particle_count,
                 PairSumOfParticle<Real, Dim, Kernel, Pass>{neighbours, function, pass});
#else
  (void)space;
  const int cells = neighbours.cell_count();
  exec::FirstFailure failure;
#pragma omp parallel
  {
    NeighbourBlocks<Real, Dim, static_cast<int>(exec::Pack<Real>::size())> seen(neighbours.radius);
#pragma omp for schedule(static)
    for (int cell = 0; cell < cells; ++cell) {
      try {
        pair_sums_of_cell(neighbours, function, pass, cell, seen);
      } catch (...) {
        failure.keep();
      }
    }
  }
  failure.rethrow();
#endif
}

/// The same with the kernel of the run: the one choice made at run time.
template <class Real, int Dim, class Pass>
void pair_sum(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
              const Pass& pass) {
  with_kernel_function<Real>(kernel, [&](const auto& function) { pair_sum_with(space, neighbours, function, pass); });
}

}  // namespace mesogen::sph
