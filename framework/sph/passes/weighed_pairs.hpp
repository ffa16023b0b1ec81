#pragma once

#include <algorithm>

#include "mesogen/sph/pairs.hpp"
#include "sph/passes/fits.hpp"

/// The neighbours of a group of particles with their weights s_ij, to be visited twice. All that a loop over them knows
/// of the kernel is here.
namespace mesogen::sph {

template <class Real, int Dim, class Pair>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline auto weighed(const Pair& pair, const FieldView<const Real>& volume) {
  WeighedPair<typename Pair::Lane, Dim> p;
  p.slope = pair.load(volume) * pair.gradient();
  for (int d = 0; d < Dim; ++d) p.separation[d] = pair.separation[d];
  return p;
}

#ifdef __CUDACC__

/// A device computes a pair faster than it fetches it, so nothing is kept. Trivially copyable.
template <class Real, int Dim, class Kernel>
class WeighedPairs {
 public:
  using Lane = Real;
  struct Kept {};

  WeighedPairs(const Pairs<Real, Dim, Kernel>& pairs, const FieldView<const Real>& volume)
      : pairs_(pairs), volume_(volume) {}

  MESOGEN_HOST_DEVICE void keep(Index, int, Kept&) const {}
  template <class Action>
  MESOGEN_HOST_DEVICE void visit(Index first, int k, Kept&, const Action& action) const {
    pairs_.visit(first + k, [&](const auto& pair) { action(weighed<Real, Dim>(pair, volume_), pair.place); });
  }

 private:
  Pairs<Real, Dim, Kernel> pairs_;
  FieldView<const Real> volume_;
};

#else

/// On the host a pack's distances and weights are found before both visits and kept: short loops, so that a processor
/// has several packs under way at a time. They are found through a pointer, so that loops over them are compiled once
/// for all forms of the kernel. Trivially copyable.
template <class Real, int Dim>
class WeighedPairs {
 public:
  using Lane = exec::Pack<Real>;
  static constexpr int width = int(Lane::size());

  struct Kept {
    static constexpr int most = 128;  // about twice what a group usually needs
    Index particle;                   // the first of the group
    int members;
    int begin[width + 1];  // of each particle of the group, counted from the first pack of the group
    int first;             // of those that are kept
    Place<Lane> place[most];
    struct {
      alignas(Lane) Real slope[width];
      Real separation[Dim][width];
    } pack[most];
  };

  /// Keeps a pointer to the pairs.
  template <class Kernel>
  WeighedPairs(const Pairs<Real, Dim, Kernel>& pairs, const FieldView<const Real>& volume)
      : pairs_(&pairs), find_(&find<Kernel>), volume_(volume) {}
  template <class Kernel>
  WeighedPairs(const Pairs<Real, Dim, Kernel>&& pairs, const FieldView<const Real>& volume) = delete;

  /// Finds the pairs of `members` particles from `first` on.
  void keep(Index first, int members, Kept& kept) const {
    kept.particle = first;
    kept.members = members;
    find_(pairs_, volume_, 0, kept);
  }

  /// action(weighed pair, its place) for all packs of the k-th particle.
  template <class Action>
  [[gnu::always_inline]] void visit(Index, int k, Kept& kept, const Action& action) const {
    int n = kept.begin[k];
    while (n < kept.begin[k + 1]) {
      if (n < kept.first || n >= kept.first + Kept::most) find_(pairs_, volume_, n, kept);
      const int end = std::min(kept.begin[k + 1], kept.first + Kept::most);
      for (; n < end; ++n) {
        const auto& own = kept.pack[n - kept.first];
        WeighedPair<Lane, Dim> p;
        exec::load(&own.slope[0], p.slope);
        for (int d = 0; d < Dim; ++d) exec::load(&own.separation[d][0], p.separation[d]);
        action(p, kept.place[n - kept.first]);
      }
    }
  }

 private:
  template <class Kernel>
  static void find(const void* pairs, FieldView<const Real> volume, int first, Kept& kept) {
    int n = -first;
    for (int k = 0; k < kept.members; ++k) {
      kept.begin[k] = n + first;
      static_cast<const Pairs<Real, Dim, Kernel>*>(pairs)->visit(
          kept.particle + k, [&](const auto& pair) __attribute__((always_inline)) {
            if (static_cast<unsigned>(n) < static_cast<unsigned>(Kept::most)) {
              const auto p = weighed<Real, Dim>(pair, volume);
              kept.place[n] = pair.place;
              exec::store(p.slope, &kept.pack[n].slope[0]);
              for (int d = 0; d < Dim; ++d) exec::store(p.separation[d], &kept.pack[n].separation[d][0]);
            }
            ++n;
          });
    }
    kept.begin[kept.members] = n + first;
    kept.first = first;
  }

  const void* pairs_;
  void (*find_)(const void* pairs, FieldView<const Real> volume, int first, Kept& kept);
  FieldView<const Real> volume_;
};

#endif

}  // namespace mesogen::sph
