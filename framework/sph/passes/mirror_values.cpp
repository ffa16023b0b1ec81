#include "sph/mirror_values.hpp"

// On the host alone: a device goes by runs (mirror_runs.cpp).
#ifndef __CUDACC__

#include <array>

#include "mesogen/exec/for_each.hpp"
#include "mesogen/sph/kernel_function.hpp"
#include "sph/passes/mirror_fit.hpp"

namespace mesogen::sph {

namespace {

using Lane = exec::Pack<double>;

/// Of a block, in double. Lanes past its end hold numbers that count for nothing.
template <class Real>
struct Doubles {
  static constexpr int width = NeighbourBlock::width<Real>;
  alignas(64) double value[width];

  [[gnu::always_inline]] Lane operator[](int lane) const {
    Lane pack;
    exec::load(value + lane, pack);
    return pack;
  }
};

/// The kernel at a pack of distances, m. Through a pointer, so that the loop is compiled once for all forms.
struct KernelValue {
  const void* function;
  Lane (*value)(const void* function, Lane distance);
  Lane operator()(const Lane& distance) const { return value(function, distance); }
};

template <MirrorFit fit, class Real, int Dim>
struct WeightLoop {
  static constexpr int width = NeighbourBlock::width<Real>;
  using Fitting = MirrorFitting<fit, Dim>;
  using Ways = std::array<Doubles<Real>, Dim>;

  Neighbours<Real, Dim> neighbours;
  MirrorPoints<Dim> points;
  KernelValue kernel;
  double length;             // h
  double beyond[2 * width];  // 0, then what is farther than the support, in the square of h
  double* weight;

  void operator()(Index n) const {
    const Fitting fitting{MirroredWall<Dim>(points, n, length)};
    Lane sums[Fitting::moments] = {};
    Ways way;
    visit(
        n, way, [&](const NeighbourBlock& block, int lane, double* to) __attribute__((always_inline)) {
          Lane square;
          exec::load(beyond + width - block.lanes + lane, square);
          Lane from[Dim];
          for (int d = 0; d < Dim; ++d) {
            from[d] = way[d][lane];
            square = square + from[d] * from[d];
          }
          exec::store(fitting.add(kernel(exec::square_root(square) * length), from, sums), to);
        });
    double moment[Fitting::moments];
    exec::sum_lanes(sums, moment);
    const Linear<Dim> factor = fitting.solve(moment);
    visit(
        n, way, [&](const NeighbourBlock&, int lane, double* to) __attribute__((always_inline)) {
          Lane value;
          exec::load(to, value);
          Lane linear(factor.constant);
          for (int d = 0; d < Dim; ++d) linear = linear + way[d][lane] * factor.slope[d];
          exec::store(value * linear, to);
        });
  }

 private:
  /// action(block, lane, weights from there on) for each pack of each block around a point; `way`: from the point to
  /// the particles of the block, in smoothing lengths.
  template <class Action>
  [[gnu::always_inline]] void visit(Index n, Ways& way, const Action& action) const {
    const double per_length = 1.0 / length;
    for (std::int64_t at = points.block_begin[n]; at < points.block_begin[n + 1]; ++at) {
      const NeighbourBlock& block = points.block[at];
      for (int d = 0; d < Dim; ++d) {
        const double origin = points.offset[d][NeighbourBlock::most_shift + block.shift[d]] - points.local[d][n];
        const Real* const local = neighbours.local[d] + block.first;
        for (int lane = 0; lane < width; ++lane)
          way[d].value[lane] = (static_cast<double>(local[lane]) + origin) * per_length;
      }
      for (int lane = 0; lane < block.lanes; lane += int(Lane::size())) action(block, lane, weight + at * width + lane);
    }
  }
};

template <class Real, int Dim>
struct ValueLoop {
  static constexpr int width = NeighbourBlock::width<Real>;

  MirrorPoints<Dim> points;
  MirrorWeights weights;
  CurvedValues curved;
  RuleView rules;
  FieldView<Real> field;
  int components;
  Index first;

  void operator()(Index n) const {
    if (!rules) {
      for (int c = 0; c < components; ++c) field(c, first + n) = static_cast<Real>(seen(n, c, weights.linear).value);
      return;
    }
    double value[AffineRule::most] = {};  // only a field with rules has no more components
    const bool is_curved = curved.curved != nullptr && curved.curved[n] != 0;
    for (int c = 0; c < components; ++c) {
      const Seen from_wall = seen(n, c, is_curved ? weights.curved : weights.linear);
      value[c] = from_wall.value;
      if (is_curved) value[c] += (1.0 - from_wall.weight) * curved.at_wall[n * components + c];
    }
    if (is_curved && curved.along_wall) straighten(n, value);
    rules.apply(n, value, components);
    for (int c = 0; c < components; ++c) field(c, first + n) = static_cast<Real>(value[c]);
  }

 private:
  struct Seen {
    double value;
    double weight;  ///< of all particles
  };
  [[nodiscard]] Seen seen(Index n, int c, const double* weight) const {
    Lane sum(0.0);
    Lane all(0.0);
    for (std::int64_t at = points.block_begin[n]; at < points.block_begin[n + 1]; ++at) {
      const NeighbourBlock& block = points.block[at];
      const Real* const from = field.component(c) + block.first;
      Doubles<Real> values;
      // What lies beyond the block may be a wall's value that another thread writes.
      for (int lane = 0; lane < width; ++lane)
        values.value[lane] = lane < block.lanes ? static_cast<double>(from[lane]) : 0.0;
      for (int lane = 0; lane < block.lanes; lane += int(Lane::size())) {
        Lane own;
        exec::load(weight + at * width + lane, own);
        sum = sum + own * values[lane];
        all = all + own;
      }
    }
    return {exec::stdx::reduce(sum), exec::stdx::reduce(all)};
  }

  /// Gives a vector the normal part that it has at the mirror point.
  void straighten(Index n, double* value) const {
    double more = 0.0;
    for (int d = 0; d < Dim; ++d) more += (seen(n, d, weights.linear).value - value[d]) * points.normal[d][n];
    for (int d = 0; d < Dim; ++d) value[d] += more * points.normal[d][n];
  }
};

template <MirrorFit fit, class Real, int Dim>
void find_weights(const Neighbours<Real, Dim>& neighbours, const MirrorPoints<Dim>& points,
                  const SmoothingKernel& kernel, double* weight) {
  with_kernel_function<double>(kernel, [&](const auto& function) {
    using Function = std::decay_t<decltype(function)>;
    const KernelValue value{
        &function, [](const void* of, Lane distance) { return static_cast<const Function*>(of)->value(distance); }};
    using Loop = WeightLoop<fit, Real, Dim>;
    Loop loop{neighbours, points, value, kernel.smoothing_length, {}, weight};
    const double support = kernel.radius() / kernel.smoothing_length;
    for (int lane = 0; lane < Loop::width; ++lane) loop.beyond[Loop::width + lane] = 4.0 * support * support;
    exec::for_each({}, points.count, loop);
  });
}

}  // namespace

template <class Real, int Dim>
void find_mirror_weights(MirrorFit fit, const Neighbours<Real, Dim>& neighbours, const MirrorPoints<Dim>& points,
                         const SmoothingKernel& kernel, double* weight) {
  if (fit == MirrorFit::linear) return find_weights<MirrorFit::linear>(neighbours, points, kernel, weight);
  find_weights<MirrorFit::curved>(neighbours, points, kernel, weight);
}

template <class Real, int Dim>
void refresh_walls(const MirrorPoints<Dim>& points, const MirrorWeights& weights, const CurvedValues& curved,
                   const RuleView& rules, FieldView<Real> field, int components, Index first) {
  exec::for_each({}, points.count, ValueLoop<Real, Dim>{points, weights, curved, rules, field, components, first});
}

#define MESOGEN_INSTANTIATE(REAL, DIM)                                                                              \
  template void find_mirror_weights(MirrorFit, const Neighbours<REAL, DIM>&, const MirrorPoints<DIM>&,              \
                                    const SmoothingKernel&, double*);                                               \
  template void refresh_walls(const MirrorPoints<DIM>&, const MirrorWeights&, const CurvedValues&, const RuleView&, \
                              FieldView<REAL>, int, Index);
MESOGEN_INSTANTIATE(float, 2)
MESOGEN_INSTANTIATE(double, 2)
MESOGEN_INSTANTIATE(float, 3)
MESOGEN_INSTANTIATE(double, 3)
#undef MESOGEN_INSTANTIATE

}  // namespace mesogen::sph

#endif
