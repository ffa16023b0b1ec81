#pragma once

#include <algorithm>

#include "mesogen/sph/pairs.hpp"
#include "sph/passes/fits.hpp"

/// The neighbours of a particle with their weights s_ij, to be visited twice. All that a loop over them knows of the
/// kernel is here.
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

  MESOGEN_HOST_DEVICE void keep(Index, Kept&) const {}
  template <class Action>
  MESOGEN_HOST_DEVICE void visit(Index i, Kept&, const Action& action) const {
    pairs_.visit(i, [&](const auto& pair) { action(weighed<Real, Dim>(pair, volume_), pair.j); });
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
    static constexpr int most = 256 / width;  // twice what neighbours usually need
    int packs;                                // of the particle
    int first;                                // of those that are kept
    Index j[most];
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

  void keep(Index i, Kept& kept) const { find_(pairs_, volume_, i, 0, kept); }

  /// action(weighed pair, j) for all packs of a particle.
  template <class Action>
  [[gnu::always_inline]] void visit(Index i, Kept& kept, const Action& action) const {
    for (int first = 0; first < kept.packs; first += Kept::most) {
      if (kept.first != first) find_(pairs_, volume_, i, first, kept);
      const int count = std::min(kept.packs - first, Kept::most);
      for (int n = 0; n < count; ++n) {
        WeighedPair<Lane, Dim> p;
        exec::load(&kept.pack[n].slope[0], p.slope);
        for (int d = 0; d < Dim; ++d) exec::load(&kept.pack[n].separation[d][0], p.separation[d]);
        action(p, kept.j[n]);
      }
    }
  }

 private:
  template <class Kernel>
  static void find(const void* pairs, FieldView<const Real> volume, Index i, int first, Kept& kept) {
    int packs = 0;
    static_cast<const Pairs<Real, Dim, Kernel>*>(pairs)->visit(
        i, [&](const auto& pair) __attribute__((always_inline)) {
          const auto n = static_cast<unsigned>(packs++ - first);
          if (n >= static_cast<unsigned>(Kept::most)) return;
          const auto p = weighed<Real, Dim>(pair, volume);
          kept.j[n] = pair.j;
          exec::store(p.slope, &kept.pack[n].slope[0]);
          for (int d = 0; d < Dim; ++d) exec::store(p.separation[d], &kept.pack[n].separation[d][0]);
        });
    kept.packs = packs;
    kept.first = first;
  }

  const void* pairs_;
  void (*find_)(const void* pairs, FieldView<const Real> volume, Index i, int first, Kept& kept);
  FieldView<const Real> volume_;
};

#endif

}  // namespace mesogen::sph
