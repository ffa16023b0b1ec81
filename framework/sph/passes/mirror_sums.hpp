#pragma once

#include "mesogen/exec/unroll.hpp"
#include "sph/mirror_runs.hpp"
#include "sph/passes/mirror_fit.hpp"

/// The loops over mirror points whose particles are known by runs. All are trivially copyable.
namespace mesogen::sph {

/// Calls enter(run) for each run of the n-th point, and see(j, at) for each particle j of it, whose weight lies at
/// `at`. One loop over all particles, as in Pairs.
template <int Dim, class Enter, class See>
[[gnu::always_inline]] MESOGEN_HOST_DEVICE inline void visit_mirror_runs(const MirrorPoints<Dim>& points, Index n,
                                                                         const Enter& enter, const See& see) {
  Index run = points.run_begin[n];
  const Index last = points.run_begin[n + 1];
  std::ptrdiff_t at =
      static_cast<std::ptrdiff_t>(points.row_begin[n / MirrorRows::width]) * MirrorRows::width + n % MirrorRows::width;
  Index j = 0;
  Index end = 0;
  while (true) {
    if (j == end) {
      if (run == last) return;
      const NeighbourRun now = points.run[run++];
      enter(now);
      j = now.first;
      end = now.first + now.count;
    }
    see(j, at);
    ++j;
    at += MirrorRows::width;
  }
}

/// Rows of a group: the particles of the point that sees most.
template <int Dim>
struct CountMirrorRows {
  MirrorPoints<Dim> points;
  Index* number;

  MESOGEN_HOST_DEVICE void operator()(Index group) const {
    const Index first = group * MirrorRows::width;
    const Index end = points.count - first < MirrorRows::width ? points.count : first + MirrorRows::width;
    Index most = 0;
    for (Index n = first; n < end; ++n) {
      Index seen = 0;
      for (Index run = points.run_begin[n]; run < points.run_begin[n + 1]; ++run) seen += points.run[run].count;
      most = seen > most ? seen : most;
    }
    number[group] = most;
  }
};

template <MirrorFit fit, class Real, int Dim, class Kernel>
struct WeighMirrorRuns {
  using Fitting = MirrorFitting<fit, Dim>;

  Neighbours<Real, Dim> neighbours;
  MirrorPoints<Dim> points;
  Kernel kernel;
  double length;  // h
  double* weight;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Fitting fitting{MirroredWall<Dim>(points, n, length)};
    double moment[Fitting::moments];
    exec::unroll<Fitting::moments>([&](auto m) { moment[m] = 0.0; });
    visit(n, [&](const double(&way)[Dim], std::ptrdiff_t at) {
      double square = 0.0;
      exec::unroll<Dim>([&](auto d) { square = square + way[d] * way[d]; });
      weight[at] = fitting.add(kernel.value(exec::square_root(square) * length), way, moment);
    });
    const Linear<Dim> factor = fitting.solve(moment);
    visit(n, [&](const double(&way)[Dim], std::ptrdiff_t at) {
      double linear = factor.constant;
      exec::unroll<Dim>([&](auto d) { linear = linear + way[d] * factor.slope[d]; });
      weight[at] *= linear;
    });
  }

 private:
  /// action(way to the particle in smoothing lengths, place of its weight)
  template <class Action>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void visit(Index n, const Action& action) const {
    const double per_length = 1.0 / length;
    double origin[Dim] = {};
    visit_mirror_runs(
        points, n,
        [&](const NeighbourRun& run) {
          exec::unroll<Dim>([&](auto d) { origin[d] = run.shift[d] * neighbours.width[d] - points.local[d][n]; });
        },
        [&](Index j, std::ptrdiff_t at) {
          double way[Dim];
          exec::unroll<Dim>(
              [&](auto d) { way[d] = (static_cast<double>(neighbours.local[d][j]) + origin[d]) * per_length; });
          action(way, at);
        });
  }
};

/// `AnyCurved`: the field is curved at some wall particles.
template <class Real, int Dim, int Components, bool AnyCurved>
struct RefreshByRuns {
  MirrorPoints<Dim> points;
  MirrorWeights weights;
  CurvedValues curved;
  RuleView rules;
  FieldView<Real> field;
  Index first;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    double value[Components];
    bool is_curved = false;
    if constexpr (AnyCurved) is_curved = curved.curved[n] != 0;
    const double all = see(n, is_curved ? weights.curved : weights.linear, value);
    if constexpr (AnyCurved) {
      if (is_curved) continue_from_wall(n, 1.0 - all, value);
    }
    rules.apply(n, value, exec::Number<Components>{});
    exec::unroll<Components>([&](auto c) { field(c, first + n) = static_cast<Real>(value[c]); });
  }

 private:
  /// Sums over what the point sees. Returns the weight of all particles.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE double see(Index n, const double* weight,
                                                        double (&value)[Components]) const {
    double all = 0.0;
    exec::unroll<Components>([&](auto c) { value[c] = 0.0; });
    visit_mirror_runs(
        points, n, [](const NeighbourRun&) {},
        [&](Index j, std::ptrdiff_t at) {
          const double own = weight[at];
          all = all + own;
          exec::unroll<Components>([&](auto c) { value[c] = value[c] + own * static_cast<double>(field(c, j)); });
        });
    return all;
  }

  /// Adds the wall's own value with its weight; gives a vector the normal part that it has at the mirror point.
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void continue_from_wall(Index n, double of_wall,
                                                                     double (&value)[Components]) const {
    const double* const at_wall = curved.at_wall + static_cast<std::ptrdiff_t>(n) * Components;
    exec::unroll<Components>([&](auto c) { value[c] += of_wall * at_wall[c]; });
    if constexpr (Components == Dim) {
      if (!curved.along_wall) return;
      double straight[Components];
      (void)see(n, weights.linear, straight);
      double more = 0.0;
      exec::unroll<Dim>([&](auto d) { more += (straight[d] - value[d]) * points.normal[d][n]; });
      exec::unroll<Dim>([&](auto d) { value[d] += more * points.normal[d][n]; });
    }
  }
};

}  // namespace mesogen::sph
