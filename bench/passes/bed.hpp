#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "mesogen/sph/pair_sum.hpp"
#include "plugin/registry.hpp"
#include "run/setup.hpp"
#include "run/stepper.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen::bench {

/// Counts neighbours within the support; itself among them.
template <class Real>
struct CountNeighbours {
  static constexpr int sum_count = 1;
  Real* found;

  struct Own {};
  Own load(Index) const { return {}; }
  template <class Pair, class Lane>
  [[gnu::always_inline]] void pair(const Own&, const Pair& p, Lane* sum) const {
    sum[0] = sum[0] + p.inside(Lane(Real(1)));
  }
  void finish(Index i, const Own&, const Real* sum) const { found[i] = sum[0]; }
};

/// Particles in a periodic box, each up to a fifth of a spacing off a lattice, stored and with neighbours found as in a
/// run; and fields over them.
template <class Real>
class Bed {
 public:
  /// `kernel`: name of a plugin; support is 4 spacings for all that there are.
  Bed(const std::string& kernel, int across) {
    Problems problems;
    const std::string spacing = std::to_string(1.0 / across);
    const std::string text =
        "domain = { size = [1.0, 1.0], boundary = \"periodic_wrap\" }\nparticles = { spacing = " + spacing +
        ", arrangement = \"jittered\", jitter = 0.2 }\nkernel = { type = \"" + kernel +
        "\", smoothing_length = " + (kernel == "quintic" ? "1.3333333333333333" : "2.0") +
        " }\nphysics.flow = { type = \"wcsph\", density = 1.0, viscosity = 1.0 }\ntime.end = 1.0\n" +
        "run.precision = \"" + (sizeof(Real) == sizeof(float) ? "single" : "double") + "\"\n";
    setup_ =
        set_up(read_case_text(text, "bed.toml", {}, problems), PluginRegistry::only({MESOGEN_BENCH_PLUGINS}), problems);
    stepper_ = std::make_unique<Stepper>(*setup_);
    State& state = stepper_->state();
    state.order.settle();
    state.neighbourhood.fill(neighbours, exec::Side::host);
    const FieldView<Real> even = field(1);
    std::fill_n(even.base, count(), Real(setup_->scene.spacing * setup_->scene.spacing));
    volume = {even.base, even.stride};
    std::vector<Real> found(static_cast<std::size_t>(count()));
    sph::pair_sum<Real, 2>({}, neighbours, kernel_of_run(), CountNeighbours<Real>{found.data()});
    for (const Real n : found) pairs += static_cast<std::int64_t>(n) - 1;
  }

  [[nodiscard]] Index count() const { return neighbours.particle_count; }
  [[nodiscard]] const sph::SmoothingKernel& kernel_of_run() const { return setup_->smoothing; }

  /// A field of smooth values, of the bed's own.
  FieldView<Real> field(int components) {
    // As much behind it as a pack may read.
    const std::ptrdiff_t stride = count() + 16;
    auto& values = values_.emplace_back(static_cast<std::size_t>(stride * components));
    for (std::size_t n = 0; n < values.size(); ++n)
      values[n] = Real(1.0 + 0.1 * std::sin(0.01 * static_cast<double>(n)));
    return {values.data(), stride};
  }
  FieldView<const Real> source(int components) {
    const FieldView<Real> made = field(components);
    return {made.base, made.stride};
  }

  /// Derivatives of `components` scalars, the correction among them.
  sph::Derivatives<Real, 2> derivatives(int components, bool consistent) {
    sph::Derivatives<Real, 2> wanted{};
    wanted.volume = volume;
    wanted.consistent = consistent;
    wanted.count = components;
    wanted.correction = field(4);
    for (int n = 0; n < components; ++n) {
      wanted.source[n] = field(1).base;
      for (Real*& gradient : wanted.gradient[n]) gradient = field(1).base;
      wanted.laplacian[n] = field(1).base;
    }
    return wanted;
  }

  Neighbours<Real, 2> neighbours{};
  FieldView<const Real> volume;
  std::int64_t pairs = 0;  ///< (i, j), j within the support of i and not i

  /// Lanes of the packs that a pass visits on the host; what is not one of `pairs` is waste.
  [[nodiscard]] std::int64_t lanes() const {
    constexpr int width = exec::Pack<Real>::size();
    std::int64_t all = 0;
    for (std::int64_t n = 0; n < neighbours.block_begin[count()]; ++n)
      all += (neighbours.block[n].lanes + width - 1) / width * width;
    return all;
  }

 private:
  std::unique_ptr<Setup> setup_;
  std::unique_ptr<Stepper> stepper_;
  std::deque<std::vector<Real>> values_;
};

}  // namespace mesogen::bench
