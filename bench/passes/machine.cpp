#include "machine.hpp"

#include <benchmark/benchmark.h>

#include <vector>

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"

namespace mesogen::bench {

namespace {

benchmark::Counter rate(double amount) { return {amount, benchmark::Counter::kIsIterationInvariantRate}; }

/// a = b + s c on arrays far larger than caches (McCalpin's STREAM triad): two read, one written.
void triad(benchmark::State& state) {
  constexpr std::size_t count = 16 << 20;
  std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
  for (auto _ : state) {
    for (std::size_t n = 0; n < count; ++n) a[n] = b[n] + 3.0 * c[n];
    benchmark::ClobberMemory();
  }
  state.counters["bytes_per_second"] = rate(3.0 * count * sizeof(double));
}

/// Multiplications with additions that do not wait for each other.
template <class Real>
void multiply_add(benchmark::State& state) {
  using Lane = exec::Pack<Real>;
  constexpr int chains = 12;
  constexpr int turns = 4096;
  Lane sum[chains];
  exec::unroll<chains>([&](auto n) { sum[n] = Lane(Real(n)); });
  Lane factor(Real(0.999));
  for (auto _ : state) {
    benchmark::DoNotOptimize(factor);
    for (int turn = 0; turn < turns; ++turn)
      exec::unroll<chains>([&](auto n) __attribute__((always_inline)) { sum[n] = sum[n] * factor + factor; });
    exec::unroll<chains>([&](auto n) { benchmark::DoNotOptimize(sum[n]); });
  }
  state.counters["operations_per_second"] = rate(2.0 * turns * chains * static_cast<double>(Lane::size()));
}

}  // namespace

void add_machine() {
  benchmark::RegisterBenchmark("machine: triad", triad)->UseRealTime();
  benchmark::RegisterBenchmark("machine: multiply, add/single", multiply_add<float>)->UseRealTime();
  benchmark::RegisterBenchmark("machine: multiply, add/double", multiply_add<double>)->UseRealTime();
}

}  // namespace mesogen::bench
