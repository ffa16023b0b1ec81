// What does it cost that the kernel is chosen at run time? The pass of the four gradients and Laplacians with the
// quintic as a plugin's data, against the same pass with the quintic's numbers written into the code.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "domain/neighbourhood.hpp"
#include "sph/passes/derivatives.hpp"

namespace {

using namespace mesogen;

class Wrapped final : public Boundary {
 public:
  bool wraps(int) const override { return true; }
  void keep_inside(const Scene& scene, double* position, std::int32_t*) const override {
    for (int d = 0; d < 2; ++d) position[d] -= scene.box[d] * std::floor(position[d] / scene.box[d]);
  }
};

template <class Real>
struct HardCodedQuintic {
  Real inverse_length, value_scale, slope_scale;

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
class Bed {
 public:
  explicit Bed(int across) {
    scene_.box = {1.0, 1.0, 0.0};
    scene_.spacing = 1.0 / across;
    scene_.precision = sizeof(Real) == 4 ? Precision::single_precision : Precision::double_precision;
    const double h = scene_.spacing * 4.0 / 3.0;
    kernel.shape.power = 5;
    kernel.shape.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}};
    kernel.smoothing_length = h;
    kernel.scale = 7.0 / (478.0 * std::numbers::pi) / (h * h);
    hard_coded = {Real(1 / h), Real(kernel.scale), Real(-5 * kernel.scale / h)};
    scene_.smoothing_length = h;
    scene_.support = 3.0 * h;
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> jitter(-0.2 * scene_.spacing, 0.2 * scene_.spacing);
    for (int i = 0; i < across * across; ++i) {
      particles_.id.push_back(i);
      particles_.position[0].push_back((i % across + 0.5) * scene_.spacing + jitter(generator));
      particles_.position[1].push_back((i / across + 0.5) * scene_.spacing + jitter(generator));
      for (int d = 0; d < 2; ++d) particles_.images[d].push_back(0);
    }
    neighbourhood_ = std::make_unique<Neighbourhood>(scene_, boundary_);
    neighbourhood_->update(particles_);
    neighbourhood_->fill(neighbours);
    const auto stored = static_cast<std::ptrdiff_t>(across) * across + 16;
    values_.assign(static_cast<std::size_t>(stored) * 18, Real(0));
    Real* next = values_.data();
    const auto take = [&](int components) {
      Real* const from = next;
      next += components * stored;
      return from;
    };
    Real* const volume = take(1);
    std::fill_n(volume, stored, Real(scene_.spacing * scene_.spacing));
    wanted.volume = {volume, stored};
    wanted.count = 4;
    for (int n = 0; n < 4; ++n) {
      Real* const source = take(1);
      for (int i = 0; i < across * across; ++i)
        source[i] = Real(std::sin((n + 1) * 6.28 * particles_.position[n % 2][static_cast<std::size_t>(i)]));
      wanted.source[n] = source;
      for (int d = 0; d < 2; ++d) wanted.gradient[n][d] = take(1);
      wanted.laplacian[n] = take(1);
    }
  }

  sph::SmoothingKernel kernel;
  HardCodedQuintic<Real> hard_coded{};
  Neighbours<Real, 2> neighbours{};
  sph::Derivatives<Real, 2> wanted{};

 private:
  Scene scene_;
  Wrapped boundary_;
  Particles particles_;
  std::unique_ptr<Neighbourhood> neighbourhood_;
  std::vector<Real> values_;
};

template <class Real>
void chosen_at_run_time(benchmark::State& state) {
  Bed<Real> bed(500);
  for (auto _ : state)
    sph::pair_sum<Real, 2>({}, bed.neighbours, bed.kernel, sph::DerivativePass<Real, 2, 4>{bed.wanted});
}

template <class Real>
void hard_coded(benchmark::State& state) {
  Bed<Real> bed(500);
  for (auto _ : state)
    sph::pair_sum_with<Real, 2>({}, bed.neighbours, bed.hard_coded, sph::DerivativePass<Real, 2, 4>{bed.wanted});
}

BENCHMARK(chosen_at_run_time<float>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hard_coded<float>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(chosen_at_run_time<double>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(hard_coded<double>)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
