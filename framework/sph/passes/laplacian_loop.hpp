#pragma once

#include <algorithm>
#include <array>

#include "mesogen/exec/for_each.hpp"
#include "mesogen/exec/sum_across.hpp"
#include "mesogen/sph/pairs.hpp"

/// Laplacians as sums with weights that are kept. On the host alone.
namespace mesogen::sph {

template <class Real>
[[gnu::always_inline]] inline exec::Pack<Real> load(const Real* from) {
  exec::Pack<Real> lane;
  exec::load(from, lane);
  return lane;
}

/// Laplacians of `Count` scalars, for a group of particles together: then one pack holds those of the group.
/// finish(first, members, pack of each scalar).
template <class Real, int Dim, int Count, class Finish>
struct LaplacianLoop {
  using Lane = exec::Pack<Real>;
  static constexpr int group = int(Lane::size());
  Neighbours<Real, Dim> neighbours;
  const Real* weight;
  std::array<const Real*, Count> source;
  Finish finish;

  void operator()(Index n) const {
    const Index first = n * group;
    const int members = std::min<Index>(group, neighbours.particle_count - first);
    alignas(Lane) Real lanes[Count][group][group];
    for (int k = 0; k < members; ++k) {
      Lane sum[Count];
      sum_pairs(first + k, sum);
      for (int c = 0; c < Count; ++c) exec::store(sum[c], &lanes[c][k][0]);
    }
    Lane laplacian[Count];
    for (int c = 0; c < Count; ++c) {
      for (int k = members; k < group; ++k) std::fill_n(&lanes[c][k][0], group, Real(0));
      exec::sum_across(lanes[c], laplacian[c]);
    }
    finish(first, members, laplacian);
  }

 private:
  [[gnu::always_inline]] void sum_pairs(Index i, Lane (&sum)[Count]) const {
    Lane own[Count];
    exec::unroll<Count>([&](auto c) __attribute__((always_inline)) {
      own[c] = Lane(source[c][i]);
      sum[c] = Lane(Real(0));
    });
    const std::int64_t end = neighbours.block_begin[i + 1];
    for (std::int64_t block = neighbours.block_begin[i]; block < end; ++block) {
      const NeighbourBlock& seen = neighbours.block[block];
      for (int lane = 0; lane < NeighbourBlock::width<Real>; lane += group) {
        if (lane > 0 && lane >= seen.lanes) break;
        const Place<Lane> place(seen, lane);
        const Lane w = load(weight + block * NeighbourBlock::width<Real> + lane);
        exec::unroll<Count>([&](auto c) __attribute__((always_inline)) {
          sum[c] = sum[c] + w * (place.load(source[c]) - own[c]);
        });
      }
    }
  }
};

/// A pack to the places of a group's members.
template <class Real>
void put(const exec::Pack<Real>& pack, Real* to, int members) {
  constexpr int group = int(exec::Pack<Real>::size());
  if (members == group) return exec::store(pack, to);
  Real all[group];
  exec::store(pack, all);
  std::copy_n(all, members, to);
}

template <class Make>
void with_count(int count, const Make& make) {
  switch (count) {
    case 1: return make(std::integral_constant<int, 1>());
    case 2: return make(std::integral_constant<int, 2>());
    case 3: return make(std::integral_constant<int, 3>());
    default: return make(std::integral_constant<int, 4>());
  }
}

template <class Real, int Dim, int Count, class Finish>
void run_laplacians(const Neighbours<Real, Dim>& neighbours, const Real* weight,
                    const std::array<const Real*, Count>& source, const Finish& finish) {
  using Loop = LaplacianLoop<Real, Dim, Count, Finish>;
  exec::for_each({}, (neighbours.particle_count + Loop::group - 1) / Loop::group,
                 Loop{neighbours, weight, source, finish});
}

}  // namespace mesogen::sph
