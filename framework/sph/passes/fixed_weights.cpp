#include "sph/fixed_weights.hpp"

// On a device nothing is to be gained: it computes a kernel faster than it reads a weight.
#ifndef __CUDACC__

#include <algorithm>
#include <utility>

#include "sph/passes/derivatives.hpp"

namespace mesogen::sph {

namespace {

template <class Real, int Dim>
constexpr int width = FixedWeights<Real, Dim>::width;

/// Calls visit(pair) for every particle j within the support of particle i, one at a time.
template <class Real, int Dim, class Kernel, class Visit>
void visit_neighbours(const Neighbours<Real, Dim>& neighbours, const Kernel& kernel, Index i, const Visit& visit) {
  int at[Dim];
  neighbours.cell_coordinates(neighbours.cell_of[i], at);
  Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
  const int count = neighbours.segments(at, segment);
  for (int s = 0; s < count; ++s) {
    Real position[Dim];
    for (int d = 0; d < Dim; ++d) position[d] = neighbours.local[d][i] - segment[s].offset[d];
    for (Index j = segment[s].begin; j < segment[s].end; ++j) {
      const Pair<Real, Dim, Real, Kernel> pair(neighbours, kernel, j, position, Real(0));
      if (j != i && pair.distance < neighbours.radius) visit(pair);
    }
  }
}

/// The blocks that hold these particles, which are sorted: calls begin(j) where a block starts, with its first lane.
template <int Width, class Begin>
void cut_into_blocks(const std::vector<Index>& sorted, const Begin& begin) {
  Index end = -1;
  for (const Index j : sorted) {
    if (j < end) continue;
    begin(j);
    end = j + Width;
  }
}

/// The weights of a pass of derivatives: it is linear in the scalar, so the weight of a neighbour is what comes out
/// where the scalar is one there and zero elsewhere.
template <class Real, int Dim, template <class, int, int> class PassOf>
class WeightFinder {
  using Pass = PassOf<Real, Dim, 1>;
  static constexpr int moments = PassOf<Real, Dim, 0>::sum_count;  // the sums of the scalar come behind them

 public:
  WeightFinder(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
               const Derivatives<Real, Dim>& wanted, Index stored, FixedWeights<Real, Dim>& weights)
      : neighbours_(neighbours), kernel_(kernel), weights_(weights), one_(static_cast<std::size_t>(stored), Real(1)) {
    result_.resize(static_cast<std::size_t>(neighbours.particle_count) * (1 + Dim));
    Real* const results = result_.data();
    unit_.volume = wanted.volume;
    unit_.count = 1;
    unit_.source[0] = one_.data();
    for (int n = 0; n < wanted.count; ++n) {
      if (wanted.laplacian[n] != nullptr) unit_.laplacian[0] = results;
      if (wanted.gradient[n][0] != nullptr)
        for (int d = 0; d < Dim; ++d)
          unit_.gradient[0][d] = results + static_cast<std::ptrdiff_t>(1 + d) * neighbours.particle_count;
    }
  }

  template <class MakePass>
  void find(const MakePass& make_pass) {
    with_kernel_function<Real>(kernel_, [&](const auto& function) {
      count_blocks(function);
      const Pass pass = make_pass(unit_);
#pragma omp parallel
      {
        std::vector<Index> seen;
#pragma omp for schedule(static)
        for (Index i = 0; i < neighbours_.particle_count; ++i) find_of_particle(function, pass, i, seen);
      }
    });
  }

 private:
  template <class Kernel>
  void list_neighbours(const Kernel& function, Index i, std::vector<Index>& seen) const {
    seen.clear();
    visit_neighbours(neighbours_, function, i, [&](const auto& pair) { seen.push_back(pair.j); });
    std::sort(seen.begin(), seen.end());
  }

  template <class Kernel>
  void count_blocks(const Kernel& function) {
    const Index count = neighbours_.particle_count;
    auto& begin = weights_.begin;
    begin.assign(static_cast<std::size_t>(count) + 1, 0);
#pragma omp parallel
    {
      std::vector<Index> seen;
#pragma omp for schedule(static)
      for (Index i = 0; i < count; ++i) {
        list_neighbours(function, i, seen);
        std::int64_t blocks = 0;
        cut_into_blocks<width<Real, Dim>>(seen, [&](Index) { ++blocks; });
        begin[static_cast<std::size_t>(i) + 1] = blocks;
      }
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    const auto blocks = static_cast<std::size_t>(begin.back());
    weights_.first.assign(blocks, 0);
    weights_.laplacian.assign(unit_.laplacian[0] == nullptr ? 0 : blocks * width<Real, Dim>, Real(0));
    for (auto& gradient : weights_.gradient)
      gradient.assign(unit_.gradient[0][0] == nullptr ? 0 : blocks * width<Real, Dim>, Real(0));
  }

  template <class Kernel>
  void find_of_particle(const Kernel& function, const Pass& pass, Index i, std::vector<Index>& seen) {
    list_neighbours(function, i, seen);
    const std::int64_t first_block = weights_.begin[static_cast<std::size_t>(i)];
    std::int64_t blocks = first_block;
    cut_into_blocks<width<Real, Dim>>(seen, [&](Index j) { weights_.first[static_cast<std::size_t>(blocks++)] = j; });

    const typename Pass::Own zero{};
    Real all[Pass::sum_count] = {};
    visit_neighbours(neighbours_, function, i, [&](const auto& pair) { pass.pair(zero, pair, all); });
    visit_neighbours(neighbours_, function, i, [&](const auto& pair) {
      Real sums[Pass::sum_count] = {};
      pass.pair(zero, pair, sums);
      std::copy_n(all, moments, sums);
      pass.finish(i, zero, sums);
      const auto at = std::upper_bound(weights_.first.begin() + first_block, weights_.first.begin() + blocks, pair.j);
      const std::int64_t block = at - weights_.first.begin() - 1;
      const auto lane =
          static_cast<std::size_t>(block * width<Real, Dim> + pair.j - weights_.first[static_cast<std::size_t>(block)]);
      // Of a particle that is seen on both sides of a small box both images count.
      if (!weights_.laplacian.empty()) weights_.laplacian[lane] += unit_.laplacian[0][i];
      for (int d = 0; d < Dim; ++d)
        if (!weights_.gradient[d].empty()) weights_.gradient[d][lane] += unit_.gradient[0][d][i];
    });
  }

  const Neighbours<Real, Dim>& neighbours_;
  const SmoothingKernel& kernel_;
  FixedWeights<Real, Dim>& weights_;
  std::vector<Real> one_;
  std::vector<Real> result_;
  Derivatives<Real, Dim> unit_{};
};

/// All scalars of a particle while its weights are in the cache.
template <class Real, int Dim>
struct WeightedSums {
  static constexpr int lanes = width<Real, Dim>;
  using Lane = exec::stdx::simd<Real, exec::stdx::simd_abi::deduce_t<Real, lanes>>;
  const std::int64_t* begin;
  const Index* first;
  const Real* laplacian;
  const Real* gradient[Dim];
  Derivatives<Real, Dim> wanted;

  void operator()(Index i) const {
    for (int n = 0; n < wanted.count; ++n) {
      const bool gradient_wanted = wanted.gradient[n][0] != nullptr;
      if (wanted.laplacian[n] != nullptr && gradient_wanted) {
        sum<true, true>(i, n);
      } else if (gradient_wanted) {
        sum<false, true>(i, n);
      } else {
        sum<true, false>(i, n);
      }
    }
  }

 private:
  static Lane load(const Real* from) { return Lane(from, exec::stdx::element_aligned); }

  template <bool Laplacian, bool Gradient>
  [[gnu::always_inline]] void sum(Index i, int n) const {
    const Real* const source = wanted.source[n];
    const Lane own(source[i]);
    Lane laplacian_sum(Real(0));
    Lane gradient_sum[Dim] = {};
    const std::int64_t end = begin[i + 1];
    for (std::int64_t block = begin[i]; block < end; ++block) {
      const Lane difference = load(source + first[block]) - own;
      if constexpr (Laplacian) laplacian_sum += load(laplacian + block * lanes) * difference;
      if constexpr (Gradient)
        exec::unroll<Dim>([&](auto d) { gradient_sum[d] += load(gradient[d] + block * lanes) * difference; });
    }
    if constexpr (Laplacian) wanted.laplacian[n][i] = exec::stdx::reduce(laplacian_sum);
    if constexpr (Gradient)
      exec::unroll<Dim>([&](auto d) { wanted.gradient[n][d][i] = exec::stdx::reduce(gradient_sum[d]); });
  }
};

}  // namespace

template <class Real, int Dim>
void find_weights(const Neighbours<Real, Dim>& neighbours, const SmoothingKernel& kernel,
                  const Derivatives<Real, Dim>& wanted, Index stored, FixedWeights<Real, Dim>& weights) {
  if (wanted.consistent) {
    WeightFinder<Real, Dim, ConsistentDerivativePass>(neighbours, kernel, wanted, stored, weights)
        .find([&](const Derivatives<Real, Dim>& unit) {
          return ConsistentDerivativePass<Real, Dim, 1>{unit, Real(kernel.smoothing_length)};
        });
  } else {
    WeightFinder<Real, Dim, DerivativePass>(neighbours, kernel, wanted, stored, weights)
        .find([](const Derivatives<Real, Dim>& unit) { return DerivativePass<Real, Dim, 1>{unit}; });
  }
}

template <class Real, int Dim>
void derivatives(const exec::Space& space, const FixedWeights<Real, Dim>& weights,
                 const Derivatives<Real, Dim>& wanted) {
  WeightedSums<Real, Dim> sums{weights.begin.data(), weights.first.data(), weights.laplacian.data(), {}, wanted};
  for (int d = 0; d < Dim; ++d) sums.gradient[d] = weights.gradient[d].data();
  exec::for_each(space, static_cast<Index>(weights.begin.size()) - 1, sums);
}

template void find_weights<float, 2>(const Neighbours<float, 2>&, const SmoothingKernel&, const Derivatives<float, 2>&,
                                     Index, FixedWeights<float, 2>&);
template void find_weights<double, 2>(const Neighbours<double, 2>&, const SmoothingKernel&,
                                      const Derivatives<double, 2>&, Index, FixedWeights<double, 2>&);
template void derivatives<float, 2>(const exec::Space&, const FixedWeights<float, 2>&, const Derivatives<float, 2>&);
template void derivatives<double, 2>(const exec::Space&, const FixedWeights<double, 2>&, const Derivatives<double, 2>&);

}  // namespace mesogen::sph

#endif
