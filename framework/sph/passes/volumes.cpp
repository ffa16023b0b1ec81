#include "mesogen/sph/pair_sum.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

namespace {

template <class Real, int Dim>
struct VolumePass {
  static constexpr int sum_count = 1;
  FieldView<Real> volume;

  struct Own {};
  MESOGEN_HOST_DEVICE Own load(Index) const { return {}; }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own&, const Pair& p, Lane* sum) const {
    sum[0] = sum[0] + p.value_alone();
  }
  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const { volume(i) = Real(1) / sum[0]; }
};

}  // namespace

template <class Real, int Dim>
void volumes(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
             FieldView<Real> volume) {
  pair_sum<Real, Dim>(space, neighbours, kernel, VolumePass<Real, Dim>{volume});
}

template void volumes<float, 2>(const exec::Space&, const Neighbours<float, 2>&, const SmoothingKernel&,
                                FieldView<float>);
template void volumes<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const SmoothingKernel&,
                                 FieldView<double>);

}  // namespace mesogen::sph
