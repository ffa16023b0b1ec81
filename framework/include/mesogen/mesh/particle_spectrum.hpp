#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/mesh/fourier_transform.hpp"
#include "mesogen/mesh/particle_mesh.hpp"

namespace mesogen::mesh {

/// Fourier modes of what particles carry, and values of modes at particles. Modes beyond a cutoff, two thirds of the
/// largest wave number of the grid along an axis, are zero. So a product of two fields has no aliased modes, and what
/// spreading takes from a wave can be restored (by a factor of at most 2.1 per axis).
template <int Dim>
class ParticleSpectrum {
 public:
  using WaveVector = std::array<double, Dim>;

  explicit ParticleSpectrum(const Grid<Dim>& grid)
      : grid_(grid), mesh_(grid), transform_(grid), restore_(grid.mode_count(), 0.0) {
    for_each_mode([&](std::size_t n, const WaveVector& k) {
      double kept = 1.0;
      for (int d = 0; d < Dim; ++d) {
        if (std::abs(k[d]) > cutoff(d) * (1.0 + 1e-12)) return;
        kept *= CubicSpline::transform(0.5 * k[d] * grid_.spacing(d));
      }
      restore_[n] = 1.0 / kept;
    });
    weight_.resize(grid.point_count());
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return grid_; }
  [[nodiscard]] std::size_t mode_count() const { return restore_.size(); }
  [[nodiscard]] double cutoff(int axis) const { return 2.0 / 3.0 * grid_.highest(axis); }
  [[nodiscard]] bool has(std::size_t mode) const { return restore_[mode] > 0.0; }
  [[nodiscard]] FourierTransform& transform() { return transform_; }

  static double square(const WaveVector& k) {
    double sum = 0.0;
    for (const double component : k) sum += component * component;
    return sum;
  }

  /// Calls action(n, k) for all modes, in parallel. No function that is called in parallel here may throw.
  template <class Action>
  void for_each_mode(const Action& action) const {
    const int rows = grid_.row_count();
    const int in_row = grid_.modes_in_row();
#pragma omp parallel for schedule(static) if (rows * in_row >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      std::array<int, Dim> at{};
      grid_.row_coordinates(row, at);
      WaveVector k{};
      for (int d = 1; d < Dim; ++d) k[d] = grid_.wave_number(d, at[d]);
      for (int n = 0; n < in_row; ++n) {
        k[0] = grid_.wave_number(0, n);
        action(static_cast<std::size_t>(row) * static_cast<std::size_t>(in_row) + static_cast<std::size_t>(n), k);
      }
    }
  }

  /// Takes the positions of the particles, m; the functions below use them. Throws Error(run_failed) if one is not
  /// finite. `origin`: position of the first point of the grid, m; modes are those of a field as seen from there.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    int lost = 0;
#pragma omp parallel for schedule(static) reduction(| : lost) if (count >= parallel_threshold)
    for (Index i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) lost |= static_cast<int>(!(std::abs(position[d][i]) < 1e9 * grid_.length[d]));
    if (lost != 0) throw Error(ExitCode::run_failed, "the coordinate of a particle is not finite");
    mesh_.locate(position, count, origin);
    weighed_ = false;
  }

  /// Modes of the number density over its mean, minus 1: zero if particles lie evenly. Throws as fit() does.
  void unevenness(Complex* modes) {
    weigh();
    values(1);
    const double per_mean = static_cast<double>(grid_.point_count()) / mesh_.count();
    const auto points = static_cast<std::ptrdiff_t>(weight_.size());
#pragma omp parallel for schedule(static) if (points >= parallel_threshold)
    for (std::ptrdiff_t x = 0; x < points; ++x)
      values_[0][static_cast<std::size_t>(x)] = weight_[static_cast<std::size_t>(x)] * per_mean - 1.0;
    transform_.forward(values_[0].data(), modes);
    for_each_mode([&](std::size_t n, const WaveVector&) { modes[n] *= restore_[n]; });
  }

  /// Computes the modes of a field. value(i, numbers) must write its `Count` components at particle i. The first guess
  /// is the weighted mean about each point of the grid, where what spreading takes from a wave is restored. Then, up to
  /// `corrections` times, the same is done with what is still missing at the particles, and added. So the result comes
  /// near the least-squares fit. Throws Error(run_failed) if hardly any particle is near a point of the grid.
  template <int Count, class Value>
  void fit(const Value& value, const std::array<Complex*, Count>& modes, int corrections) {
    spread<Count>(value, modes, false);
    // The first guess misses about a share u, the unevenness, of a field. A correction misses 3 u of what it corrects
    // (measured on lattices with jitter and in turbulence).
    double missing = uneven_;
    for (int n = 0; n < corrections && missing > missed; ++n, missing *= 3.0 * uneven_) {
      missing_.resize(static_cast<std::size_t>(mesh_.count()) * Count);
      work_modes(Count);
      std::array<Complex*, Count> copy{};
      for (int c = 0; c < Count; ++c) {
        std::copy(modes[c], modes[c] + mode_count(), work_modes_[c].data());
        copy[c] = work_modes_[c].data();
      }
      evaluate<Count>(copy, [&](Index i, const double* there) {
        double numbers[Count];
        value(i, numbers);
        for (int c = 0; c < Count; ++c)
          missing_[static_cast<std::size_t>(i) * Count + static_cast<std::size_t>(c)] = numbers[c] - there[c];
      });
      spread<Count>(
          [&](Index i, double* numbers) {
            for (int c = 0; c < Count; ++c)
              numbers[c] = missing_[static_cast<std::size_t>(i) * Count + static_cast<std::size_t>(c)];
          },
          modes, true);
    }
  }

  /// Calls take(i, numbers) for every particle, with the values of these modes there. Overwrites `modes`.
  template <int Count, class Take>
  void evaluate(const std::array<Complex*, Count>& modes, const Take& take) {
    values(Count);
    std::array<const double*, Count> from{};
    for (int c = 0; c < Count; ++c) {
      for_each_mode([&](std::size_t n, const WaveVector&) { modes[c][n] *= restore_[n]; });
      transform_.backward(modes[c], values_[c].data());
      from[c] = values_[c].data();
    }
    mesh_.template gather<Count>(from, take);
  }

 private:
  static constexpr double empty = 1e-3;   // weight of a point with hardly any particle, over the mean weight
  static constexpr double missed = 3e-3;  // no further correction if less than this share of a field is missing

  void values(int count) {
    if (static_cast<int>(values_.size()) < count) values_.resize(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) values_[static_cast<std::size_t>(c)].resize(grid_.point_count());
  }
  void work_modes(int count) {
    if (static_cast<int>(work_modes_.size()) < count) work_modes_.resize(static_cast<std::size_t>(count));
    for (int c = 0; c < count; ++c) work_modes_[static_cast<std::size_t>(c)].resize(mode_count());
  }

  // Weight of the particles near each point, and the unevenness.
  void weigh() {
    if (weighed_) return;
    mesh_.template spread<1>([](Index, double* one) { one[0] = 1.0; }, {weight_.data()});
    const double mean = static_cast<double>(mesh_.count()) / static_cast<double>(grid_.point_count());
    // Row by row, so that the sum is rounded in the same way for any number of threads.
    double least = mean;
    const int rows = grid_.row_count();
    const int columns = grid_.points[0];
    row_sums_.resize(static_cast<std::size_t>(rows));
#pragma omp parallel for schedule(static) reduction(min : least) if (rows * columns >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      double sum = 0.0;
      for (int x = 0; x < columns; ++x) {
        const double weight =
            weight_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
        least = std::min(least, weight);
        sum += (weight - mean) * (weight - mean);
      }
      row_sums_[static_cast<std::size_t>(row)] = sum;
    }
    double square = 0.0;
    for (const double sum : row_sums_) square += sum;
    uneven_ = std::sqrt(square / static_cast<double>(grid_.point_count())) / mean;
    if (!(least > empty * mean))
      throw Error(
          ExitCode::run_failed,
          "a point of the mesh has hardly any particle about it: leave the shift of the flow at its default, or "
          "take a coarser mesh (mesh_spacing of a flow on a mesh)");
    weighed_ = true;
  }

  template <int Count, class Value>
  void spread(const Value& value, const std::array<Complex*, Count>& modes, bool add) {
    weigh();
    values(Count);
    std::array<double*, Count> to{};
    for (int c = 0; c < Count; ++c) to[c] = values_[static_cast<std::size_t>(c)].data();
    mesh_.template spread<Count>(value, to);
    spread_modes_.resize(mode_count());
    const auto points = static_cast<std::ptrdiff_t>(weight_.size());
    for (int c = 0; c < Count; ++c) {
#pragma omp parallel for schedule(static) if (points >= parallel_threshold)
      for (std::ptrdiff_t x = 0; x < points; ++x) to[c][x] /= weight_[static_cast<std::size_t>(x)];
      transform_.forward(to[c], spread_modes_.data());
      for_each_mode([&](std::size_t n, const WaveVector&) {
        const Complex mode = spread_modes_[n] * restore_[n];
        modes[c][n] = add ? modes[c][n] + mode : mode;
      });
    }
  }

  Grid<Dim> grid_;
  ParticleMesh<Dim> mesh_;
  FourierTransform transform_;
  std::vector<double> restore_;  // 1 / (factor by which spreading reduces a wave); 0 beyond the cutoff
  std::vector<double> weight_;   // of all particles at each point
  bool weighed_ = false;
  double uneven_ = 0.0;
  std::vector<double> row_sums_;
  std::vector<std::vector<double>> values_;
  std::vector<std::vector<Complex>> work_modes_;
  std::vector<Complex> spread_modes_;
  std::vector<double> missing_;
};

}  // namespace mesogen::mesh
