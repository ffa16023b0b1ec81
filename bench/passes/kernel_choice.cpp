// What does it cost that the kernel is chosen at run time? The pass of the four gradients and Laplacians with the
// quintic as a plugin's data, against the same pass with the quintic's numbers written into the code. Both call the
// function that weighs pairs through a pointer, once a particle.

#include <benchmark/benchmark.h>

#include "bed.hpp"
#include "sph/passes/derivatives.hpp"

namespace {

using namespace mesogen;
using bench::Bed;

template <class Real>
struct HardCodedQuintic {
  Real inverse_length, slope_scale;

  template <class Lane>
  [[gnu::always_inline]] Lane derivative(const Lane& r) const {
    const Lane q = r * inverse_length;
    const Lane a = exec::positive_part(Lane(Real(3)) - q);
    const Lane b = exec::positive_part(Lane(Real(2)) - q);
    const Lane c = exec::positive_part(Lane(Real(1)) - q);
    const Lane a2 = a * a;
    const Lane b2 = b * b;
    const Lane c2 = c * c;
    return (a2 * a2 - b2 * b2 * Real(6) + c2 * c2 * Real(15)) * slope_scale;
  }
};

template <class Real>
void chosen_at_run_time(benchmark::State& state) {
  Bed<Real> bed("quintic", 500);
  const auto wanted = bed.derivatives(4, true);
  for (auto _ : state) sph::run_derivatives<Real, 2>({}, bed.neighbours, bed.kernel_of_run(), wanted);
}

template <class Real>
void hard_coded(benchmark::State& state) {
  Bed<Real> bed("quintic", 500);
  const auto wanted = bed.derivatives(4, true);
  const auto& kernel = bed.kernel_of_run();
  const double h = kernel.smoothing_length;
  const HardCodedQuintic<Real> function{Real(1.0 / h), Real(-5.0 * kernel.scale / h)};
  const sph::Pairs pairs(bed.neighbours, function);
  using Source = sph::WeighedPairs<Real, 2>;
  using Loop = sph::DerivativeLoop<Real, 2, 4, sph::ConsistentFit<Real>, Source>;
  const Loop loop(Source(pairs, wanted.volume), {Real(h)}, wanted, bed.count());
  for (auto _ : state) exec::for_each({}, (bed.count() + Loop::group - 1) / Loop::group, loop);
}

BENCHMARK(chosen_at_run_time<float>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hard_coded<float>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(chosen_at_run_time<double>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hard_coded<double>)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
