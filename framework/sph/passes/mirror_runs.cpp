#include "sph/mirror_runs.hpp"

#include <algorithm>

#include "mesogen/sph/kernel_function.hpp"
#include "particles/components.hpp"
#include "sph/passes/mirror_sums.hpp"
#include "sph/passes/neighbour_runs.hpp"

namespace mesogen::sph {

namespace {

template <MirrorFit fit, class Real, int Dim>
void find_weights(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const MirrorPoints<Dim>& points,
                  const SmoothingKernel& kernel, double* weight) {
  with_kernel_function<double>(kernel, [&](const auto& function) {
    using Loop = WeighMirrorRuns<fit, Real, Dim, std::decay_t<decltype(function)>>;
    exec::for_each(space, points.count, Loop{neighbours, points, function, kernel.smoothing_length, weight},
                   "weights at walls");
  });
}

}  // namespace

template <class Real, int Dim>
void count_mirror_runs(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                       const MirrorPoints<Dim>& points, double range, Index* number) {
  exec::for_each(space, points.count,
                 FindMirrorRuns<Real, Dim, false>{neighbours, points, Real(range * range), number, nullptr},
                 "counting neighbours of walls");
}

template <class Real, int Dim>
void list_mirror_runs(const exec::Space& space, const Neighbours<Real, Dim>& neighbours,
                      const MirrorPoints<Dim>& points, double range, NeighbourRun* run) {
  exec::for_each(space, points.count,
                 FindMirrorRuns<Real, Dim, true>{neighbours, points, Real(range * range), nullptr, run},
                 "listing neighbours of walls");
}

template <int Dim>
void count_mirror_rows(const exec::Space& space, const MirrorPoints<Dim>& points, Index* number) {
  exec::for_each(space, MirrorRows::groups(points.count), CountMirrorRows<Dim>{points, number},
                 "counting rows of weights");
}

template <class Real, int Dim>
void find_mirror_weights(const exec::Space& space, MirrorFit fit, const Neighbours<Real, Dim>& neighbours,
                         const MirrorPoints<Dim>& points, const SmoothingKernel& kernel, double* weight) {
  if (fit == MirrorFit::linear) return find_weights<MirrorFit::linear>(space, neighbours, points, kernel, weight);
  find_weights<MirrorFit::curved>(space, neighbours, points, kernel, weight);
}

template <class Real, int Dim>
void refresh_walls(const exec::Space& space, const MirrorPoints<Dim>& points, const MirrorWeights& weights,
                   const CurvedValues& curved, const RuleView& rules, FieldView<Real> field, int components,
                   Index first) {
  const auto refresh = [&]<int Components, bool AnyCurved>(FieldView<Real> part) {
    using Loop = RefreshByRuns<Real, Dim, Components, AnyCurved>;
    exec::for_each(space, points.count, Loop{points, weights, curved, rules, part, first}, "values at walls");
  };
  if (!rules) {
    // Such a field may have any number of components: a few at a time.
    constexpr int most = 4;
    for (int c = 0; c < components; c += most)
      exec::for_components(std::min(most, components - c), [&]<int Components>() {
        refresh.template operator()<Components, false>({field.component(c), field.stride});
      });
    return;
  }
  exec::for_components(components, [&]<int Components>() {
    if (curved.curved != nullptr) return refresh.template operator()<Components, true>(field);
    refresh.template operator()<Components, false>(field);
  });
}

#define MESOGEN_INSTANTIATE(REAL, DIM)                                                                                 \
  template void count_mirror_runs(const exec::Space&, const Neighbours<REAL, DIM>&, const MirrorPoints<DIM>&, double,  \
                                  Index*);                                                                             \
  template void list_mirror_runs(const exec::Space&, const Neighbours<REAL, DIM>&, const MirrorPoints<DIM>&, double,   \
                                 NeighbourRun*);                                                                       \
  template void find_mirror_weights(const exec::Space&, MirrorFit, const Neighbours<REAL, DIM>&,                       \
                                    const MirrorPoints<DIM>&, const SmoothingKernel&, double*);                        \
  template void refresh_walls(const exec::Space&, const MirrorPoints<DIM>&, const MirrorWeights&, const CurvedValues&, \
                              const RuleView&, FieldView<REAL>, int, Index);
MESOGEN_INSTANTIATE(float, 2)
MESOGEN_INSTANTIATE(double, 2)
#undef MESOGEN_INSTANTIATE
template void count_mirror_rows(const exec::Space&, const MirrorPoints<2>&, Index*);

}  // namespace mesogen::sph
