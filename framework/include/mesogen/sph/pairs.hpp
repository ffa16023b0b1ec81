#pragma once

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/neighbours.hpp"

namespace mesogen::sph {

/// Where the values of a neighbour are stored, or those of a pack of neighbours.
template <class Lane>
struct Place {
  Index j;

  template <class Real>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane load(const Real* field) const {
    Lane lane;
    exec::load(field + j, lane);
    return lane;
  }
};

#ifndef __CUDACC__
/// Of the pack of a block that begins with lane `from`.
template <class Real, class Abi>
struct Place<exec::stdx::simd<Real, Abi>> {
  using Lane = exec::stdx::simd<Real, Abi>;
  Index first;
  Index second;
  int split;  // before it in `first`, from it on in `second`

  Place() = default;
  [[gnu::always_inline]] explicit Place(const NeighbourBlock& block, int from = 0)
      : first(block.first + from), second(block.second + from), split(block.split - from) {}

  [[gnu::always_inline]] Lane load(const Real* field) const {
    Lane lane;
    exec::load(field + first, field + second, split, lane);
    return lane;
  }
};
#endif

/// One pair (i, j), or one pack of pairs (i, j), (i, j + 1), ... Only what a pass asks for is computed.
template <class Real, int Dim, class LaneType, class Kernel>
struct Pair {
  using Lane = LaneType;

  Lane separation[Dim];   ///< r_i - r_j, m
  Lane square;            ///< distance squared, m^2
  Lane distance;          ///< |r_i - r_j|, m; never exactly zero
  Lane inverse_distance;  ///< 1 / distance, 1/m
  const Kernel& kernel;
  Real radius;
  Place<Lane> place;  ///< of j

  /// Value of a field at particle j, or at the particles of the pack.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane load(const FieldView<const Real>& field, int component = 0) const {
    return place.load(field.base + component * field.stride);
  }
  /// W(r_ij), 1/m^Dim.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value() const { return kernel.value(distance); }
  /// The same for passes that need neither the distance nor its inverse: faster.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane value_alone() const { return kernel.value(exec::find_root(square)); }
  /// W'(r_ij) / r_ij, 1/m^(Dim + 2), negative. Times the separation, it is the gradient of W with respect to r_i.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane gradient() const {
    return kernel.derivative(distance) * inverse_distance;
  }
  /// Returns x where j is within the support, zero elsewhere. For sums that the kernel does not weight.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane inside(const Lane& x) const {
    return exec::where_less(distance, Lane(radius), x);
  }
  /// sum + inside(x), in one operation.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane add_inside(const Lane& x, const Lane& sum) const {
    return exec::add_where_less(distance, Lane(radius), x, sum);
  }

  /// `at`: r_i in the coordinates of j, m. `least_square`: added to the square of the distance, m^2.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Pair(const Neighbours<Real, Dim>& n, const Kernel& k,
                                                  const Place<Lane>& where, const Lane (&at)[Dim],
                                                  const Lane& least_square)
      : kernel(k), radius(n.radius), place(where) {
    square = least_square;
    exec::unroll<Dim>([&](auto d) {
      separation[d] = at[d] - place.load(n.local[d]);
      square = separation[d] * separation[d] + square;
    });
    exec::find_roots(square, distance, inverse_distance);
  }
};

/// Visits all pairs of a particle: on the host one pack of neighbours at a time, on a device one neighbour at a time.
/// Trivially copyable.
template <class Real, int Dim, class Kernel>
class Pairs {
 public:
#ifdef __CUDACC__
  using Lane = Real;

  Pairs(const Neighbours<Real, Dim>& neighbours, const Kernel& kernel) : neighbours_(neighbours), kernel_(kernel) {}

  /// Calls action(pair) for every pair (i, j) within the support, (i, i) included, and for some pairs beyond it.
  ///
  /// One loop over all neighbours, and not a loop over runs around a loop over the neighbours of a run: threads of a
  /// warp have runs of different lengths, and would wait for the longest at the end of each.
  template <class Action>
  MESOGEN_HOST_DEVICE void visit(Index i, const Action& action) const {
    Index run = neighbours_.run_begin[i];
    const Index last = neighbours_.run_begin[i + 1];
    Real own[Dim];
    for (int d = 0; d < Dim; ++d) own[d] = neighbours_.local[d][i];
    Real position[Dim];
    Index j = 0;
    Index end = 0;
    while (true) {
      if (j == end) {
        if (run == last) return;
        const NeighbourRun now = neighbours_.run[run++];
        for (int d = 0; d < Dim; ++d) position[d] = own[d] - Real(now.shift[d] * neighbours_.width[d]);
        j = now.first;
        end = now.first + now.count;
      }
      action(Pair<Real, Dim, Real, Kernel>(neighbours_, kernel_, {j}, position, neighbours_.smallest));
      ++j;
    }
  }
#else
  using Lane = exec::Pack<Real>;

  Pairs(const Neighbours<Real, Dim>& neighbours, const Kernel& kernel) : neighbours_(neighbours), kernel_(kernel) {
    for (int lane = 0; lane < width; ++lane) {
      least_square_[lane] = neighbours.smallest;
      least_square_[width + lane] = Real(16) * neighbours.radius * neighbours.radius;
    }
  }

  /// Calls action(pack) for packs that hold every pair (i, j) within the support, (i, i) included, and some beyond it.
  template <class Action>
  [[gnu::always_inline]] void visit(Index i, const Action& action) const {
    const Centre centre = place(i);
    const std::int64_t end = neighbours_.block_begin[i + 1];
    for (std::int64_t block = neighbours_.block_begin[i]; block < end; ++block)
      visit_block(
          centre,
          neighbours_.block[block], [&](int, const auto& pack) __attribute__((always_inline)) { action(pack); });
  }

  /// Position of a particle, the same in every lane, m.
  struct Centre {
    Lane local[Dim];
  };
  [[gnu::always_inline]] Centre place(Index i) const {
    Centre centre;
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) {
      centre.local[d] = exec::in_register(Lane(neighbours_.local[d][i]));
    });
    return centre;
  }

  /// Calls action(lane, pack) for the packs of one block. `lane`: number of the first lane of the pack in the block.
  template <class Action>
  [[gnu::always_inline]] void visit_block(const Centre& centre, const NeighbourBlock& block,
                                          const Action& action) const {
    const auto offset = [&](int axis, std::ptrdiff_t shift) __attribute__((always_inline)) {
      return Lane((neighbours_.offset[axis] + NeighbourBlock::most_shift)[shift]);
    };
    const Real* const least_square = least_square_ + width - std::ptrdiff_t(block.lanes);
    for (int lane = 0; lane < width; lane += int(Lane::size())) {
      if (lane > 0 && lane >= block.lanes) break;
      const Place<Lane> place(block, lane);
      Lane position[Dim];
      exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) {
        position[d] = centre.local[d] - offset(d, block.shift[d]);
        if constexpr (d > 0)
          exec::subtract_from(place.split, centre.local[d], offset(d, block.second_shift[d]), position[d]);
      });
      Lane least;
      exec::load(least_square + lane, least);
      action(lane, Pair<Real, Dim, Lane, Kernel>(neighbours_, kernel_, place, position, least));
    }
  }

#endif

 private:
  Neighbours<Real, Dim> neighbours_;
  Kernel kernel_;
#ifndef __CUDACC__
  static constexpr int width = NeighbourBlock::width<Real>;
  static_assert(width % Lane::size() == 0);
  // Lanes past the end of a block hold other particles, in coordinates of another tile: this moves them out of reach.
  Real least_square_[2 * width];
#endif
};

}  // namespace mesogen::sph
