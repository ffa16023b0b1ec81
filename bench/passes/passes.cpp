// What does a pair cost? Every sum over neighbours that the standard model has, by precision and kernel: ns a pair on
// one core, pairs counted within the support. Beside it what the pass does at a pair and how fast the machine could.
//
//     OMP_NUM_THREADS=1 build/release/bin/passes-x86-64-v4 [--across=500] [--benchmark_filter=...]
//     [--benchmark_format=json]
//
// bench/speed.py runs it and makes docs/performance.md.

#include "operations.hpp"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "../../plugins/physics/wcsph/passes.hpp"
#include "../../plugins/physics/wcsph/published_passes.hpp"
#include "bed.hpp"
#include "machine.hpp"
#include "sph/passes/weighed_pairs.hpp"

namespace {

using namespace mesogen;
using bench::Bed;

/// A pass over a bed: runs it once, and how much it does at a pair.
template <class Real>
struct Case {
  std::function<void()> run;
  int operations;
};

/// A pass struct of wcsph. `make<Number>` gives it: once to run, once to be counted, whatever it reads.
template <class Real, template <class> class Pass, class Fill>
Case<Real> sum(Bed<Real>& bed, const Fill& fill) {
  Pass<Real> pass{};
  fill(pass);
  const int operations = bench::operations(bed.kernel_of_run(), Pass<double>{});
  return {[&bed, pass] { sph::pair_sum<Real, 2>({}, bed.neighbours, bed.kernel_of_run(), pass); }, operations};
}

template <class Real>
struct Volume {
  static constexpr int sum_count = 1;
  struct Own {};
  template <class Pair, class Lane>
  void pair(const Own&, const Pair& p, Lane* sum) const {
    sum[0] = sum[0] + p.value_alone();
  }
};

/// What DerivativeLoop does at a pair, in both of its visits.
template <class Fit>
struct Derivatives {
  static constexpr int sum_count = Fit::sum_count;
  Fit fit;
  FieldView<const double> volume;
  int components;

  struct Own {};
  template <class Pair, class Lane>
  void pair(const Own&, const Pair& pair, Lane* sum) const {
    const auto p = sph::weighed<double, 2>(pair, volume);
    fit.add(p, sum);
    if (components == 0) return;
    const double weight[Fit::weight_count] = {};
    Lane along[2] = {p.slope * p.separation[0], p.slope * p.separation[1]};
    Lane total = fit.laplacian(p, along, weight);
    for (int n = 0; n < components; ++n) {
      const Lane difference = total - total;
      for (const Lane& one : {along[0], along[1], total}) sum[0] = sum[0] + one * difference;
    }
  }
};

int operations_of_derivatives(const sph::SmoothingKernel& kernel, int components, bool consistent) {
  if (consistent) return bench::operations(kernel, Derivatives<sph::ConsistentFit<double>>{{1.0}, {}, components});
  return bench::operations(kernel, Derivatives<sph::PlainFit<double, 2>>{{}, {}, components});
}

template <class Real>
using Filter = wcsph::DensityFilter<Real>;
template <class Real>
using Shift = wcsph::Shift<Real, 2, false>;
template <class Real>
using PublishedShift = wcsph::Shift<Real, 2, true>;
template <class Real>
using Momentum = wcsph::Momentum<Real, 2, false, wcsph::PressureForm::corrected>;
template <class Real>
using RadialMomentum = wcsph::Momentum<Real, 2, true, wcsph::PressureForm::corrected>;
template <class Real>
using Diffusion = wcsph::DensityDiffusion<Real>;
template <class Real>
using AllOfWcsph = sph::FusedPass<Shift<Real>, wcsph::MomentumAndDiffusion<Momentum<Real>, Diffusion<Real>>>;

template <class Real, class Pass>
void fill_shift(Bed<Real>& bed, Pass& pass) {
  pass.velocity = bed.source(2);
  pass.velocity_gradient = bed.source(4);
  pass.shift = bed.field(2);
  pass.strength = Real(0.3);
  pass.smoothing_length = Real(bed.kernel_of_run().smoothing_length);
}

template <class Real, class Pass>
void fill_momentum(Bed<Real>& bed, Pass& pass) {
  pass.volume = bed.volume;
  pass.pressure = bed.source(1);
  pass.density = bed.source(1);
  pass.correction = bed.source(4);
  pass.velocity = bed.source(2);
  pass.acceleration = bed.field(2);
  pass.viscosity = Real(1);
}

template <class Real, class Pass>
void fill_diffusion(Bed<Real>& bed, Pass& pass) {
  pass.volume = bed.volume;
  pass.compression = bed.source(1);
  pass.rate = bed.field(1);
  pass.diffusivity = Real(1);
}

template <class Real>
std::map<std::string, Case<Real>> cases(Bed<Real>& bed) {
  std::map<std::string, Case<Real>> all;
  const auto& kernel = bed.kernel_of_run();
  const FieldView<Real> volume = bed.field(1);
  all["volume"] = {[&bed, volume] { sph::volumes<Real, 2>({}, bed.neighbours, bed.kernel_of_run(), volume); },
                   bench::operations(kernel, Volume<double>{})};
  for (const bool consistent : {false, true})
    for (int components = consistent ? 1 : 0; components <= 4; ++components) {
      const auto wanted = bed.derivatives(components, consistent);
      const std::string name = components == 0 ? "correction"
                                               : std::string(consistent ? "consistent" : "plain") + " derivatives of " +
                                                     std::to_string(components);
      all[name] = {[&bed, wanted] { sph::derivatives<Real, 2>({}, bed.neighbours, bed.kernel_of_run(), wanted); },
                   operations_of_derivatives(kernel, components, consistent)};
    }
  all["density filter"] = sum<Real, Filter>(bed, [&](auto& pass) {
    pass.compression = bed.source(1);
    pass.filtered = bed.field(1);
    pass.beta = Real(1);
  });
  all["shift"] = sum<Real, Shift>(bed, [&](auto& pass) { fill_shift(bed, pass); });
  all["published shift"] = sum<Real, PublishedShift>(bed, [&](auto& pass) { fill_shift(bed, pass); });
  all["pressure, viscosity"] = sum<Real, Momentum>(bed, [&](auto& pass) { fill_momentum(bed, pass); });
  all["pressure, radial viscosity"] = sum<Real, RadialMomentum>(bed, [&](auto& pass) { fill_momentum(bed, pass); });
  all["density diffusion"] = sum<Real, Diffusion>(bed, [&](auto& pass) { fill_diffusion(bed, pass); });
  all["pressure, viscosity, shift and density diffusion"] = sum<Real, AllOfWcsph>(bed, [&](auto& pass) {
    fill_shift(bed, pass.first);
    fill_momentum(bed, pass.second.momentum);
    fill_diffusion(bed, pass.second.diffusion);
  });
  return all;
}

template <class Real>
void add_passes(const std::string& kernel, int across) {
  // Beds live as long as the program.
  auto& bed = *new Bed<Real>(kernel, across);
  for (const auto& [pass, one] : cases(bed)) {
    const std::string name = pass + "/" + kernel + "/" + (sizeof(Real) == sizeof(float) ? "single" : "double");
    benchmark::RegisterBenchmark(name.c_str(), [&bed, one = one](benchmark::State& state) {
      for (auto _ : state) one.run();
      const auto rate = [&](double amount) {
        return benchmark::Counter(amount, benchmark::Counter::kIsIterationInvariantRate);
      };
      const auto pairs = static_cast<double>(bed.pairs);
      state.counters["pairs_per_second"] = rate(pairs);
      state.counters["operations_per_second"] = rate(pairs * one.operations);
      state.counters["operations_a_pair"] = one.operations;
      state.counters["neighbours"] = pairs / bed.count();
      state.counters["lanes_a_pair"] = static_cast<double>(bed.lanes()) / pairs;
      state.counters["blocks"] = static_cast<double>(bed.neighbours.block_begin[bed.count()]) / bed.count();
    })->UseRealTime();
  }
}

}  // namespace

int main(int argc, char** argv) {
  int across = 500;
  std::vector<char*> others;
  for (int n = 0; n < argc; ++n) {
    const std::string argument = argv[n];
    if (argument.starts_with("--across=")) {
      across = std::atoi(argument.c_str() + 9);
    } else {
      others.push_back(argv[n]);
    }
  }
  int count = static_cast<int>(others.size());
  benchmark::Initialize(&count, others.data());
  if (benchmark::ReportUnrecognizedArguments(count, others.data())) return 1;
  benchmark::AddCustomContext("instruction_set", sph::instruction_set());
  for (const char* const kernel : {"quintic", "wendland_c2", "wendland_c4", "wendland_c6"}) {
    add_passes<float>(kernel, across);
    add_passes<double>(kernel, across);
  }
  bench::add_machine();
  benchmark::RunSpecifiedBenchmarks();
}
