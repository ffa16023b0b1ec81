#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/pair_sum.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::sph {

namespace {

template <class Real, int Dim, int Count>
struct GradientPass {
  static constexpr int sum_count = Count * Dim;
  FieldView<const Real> volume;
  FieldView<const Real> correction;
  const Real* source[Count];
  Real* gradient[Count][Dim];

  struct Own {
    Real value[Count];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    Own own;
    exec::unroll<Count>([&](auto n) { own.value[n] = source[n][i]; });
    return own;
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane slope = p.load(volume) * p.gradient();
    Lane weight[Dim];
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { weight[d] = slope * p.separation[d]; });
    exec::unroll<Count>([&](auto n) __attribute__((always_inline)) {
      const Lane difference = p.place.load(source[n]) - Lane(own.value[n]);
      exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { sum[n * Dim + d] += weight[d] * difference; });
    });
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    exec::unroll<Count>([&](auto n) {
      exec::unroll<Dim>([&](auto a) {
        Real component(0);
        for (int b = 0; b < Dim; ++b) component += correction(a * Dim + b, i) * sum[n * Dim + b];
        gradient[n][a][i] = component;
      });
    });
  }
};

template <int Count, class Real, int Dim>
void run(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
         const Derivatives<Real, Dim>& wanted, FieldView<const Real> correction) {
  GradientPass<Real, Dim, Count> pass{wanted.volume, correction, {}, {}};
  for (int n = 0; n < Count; ++n) {
    pass.source[n] = wanted.source[n];
    for (int d = 0; d < Dim; ++d) pass.gradient[n][d] = wanted.gradient[n][d];
  }
  pair_sum<Real, Dim>(space, neighbours, kernel, pass);
}

}  // namespace

template <class Real, int Dim>
void gradients(const exec::Space& space, const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
               const Derivatives<Real, Dim>& wanted, FieldView<const Real> correction) {
  wanted.count == 1 ? run<1>(space, neighbours, kernel, wanted, correction)
                    : run<2>(space, neighbours, kernel, wanted, correction);
}

template void gradients<float, 2>(const exec::Space&, const Neighbours<float, 2>&, const SmoothingKernel&,
                                  const Derivatives<float, 2>&, FieldView<const float>);
template void gradients<double, 2>(const exec::Space&, const Neighbours<double, 2>&, const SmoothingKernel&,
                                   const Derivatives<double, 2>&, FieldView<const double>);

}  // namespace mesogen::sph
