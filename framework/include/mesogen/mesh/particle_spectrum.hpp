#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesogen/mesh/fitting.hpp"
#include "mesogen/mesh/mode_transform.hpp"
#include "mesogen/mesh/particle_mesh.hpp"

namespace mesogen::mesh {

/// Fourier modes of what particles carry, and values of modes at particles. Modes are those of KeptModes. What
/// spreading to the mesh takes from a wave, and interpolation again, is restored (by a factor of at most 2.1 per axis).
/// `Real` is the precision of particles' values, of the mesh and of transforms; modes are in double precision.
template <int Dim, class Real = double>
class ParticleSpectrum {
 public:
  using WaveVector = typename KeptModes<Dim>::WaveVector;

  /// `sharing`: the processes that share the particles; all of them call alike, and each has the modes of all. Null:
  /// this one has them all.
  explicit ParticleSpectrum(const Grid<Dim>& grid, const exec::Sharing* sharing = nullptr)
      : mesh_(grid, sharing), transform_(grid), restore_(grid.mode_count(), 0.0), weight_(grid, 1) {
    kept().for_each([&](std::size_t n, const WaveVector& k) { restore_[n] = restoring_factor<Dim>(grid, k); });
  }

  /// Approximate memory, in bytes, for so many particles, if `fitted` fields are fitted at a time and `evaluated` are
  /// evaluated.
  static double bytes(const Grid<Dim>& grid, Index particles, int fitted, int evaluated) {
    return ParticleMesh<Dim, Real>::bytes(grid, particles, fitted + 1, evaluated) +
           FieldsOnGrid<Real>::bytes(grid) * (2 * std::max(fitted + 1, evaluated) + 1) +
           static_cast<double>(grid.mode_count() * sizeof(double));
  }

  [[nodiscard]] const Grid<Dim>& grid() const { return kept().grid(); }
  [[nodiscard]] const KeptModes<Dim>& kept() const { return transform_.kept(); }
  [[nodiscard]] std::size_t mode_count() const { return restore_.size(); }
  /// Of fields on the mesh, as they are: nothing is restored.
  [[nodiscard]] ModeTransform<Dim, Real>& transform() { return transform_; }

  /// Takes the positions of the particles, m; the functions below use them. Throws Error(run_failed) if one is not
  /// finite. `origin`: position of the first point of the grid, m; modes are those of a field as seen from there.
  void locate(const std::array<const double*, Dim>& position, Index count, const std::array<double, Dim>& origin = {}) {
    int lost = 0;
#pragma omp parallel for schedule(static) reduction(| : lost) if (count >= parallel_threshold)
    for (Index i = 0; i < count; ++i)
      for (int d = 0; d < Dim; ++d) lost |= static_cast<int>(!(std::abs(position[d][i]) < 1e9 * grid().length[d]));
    if (lost != 0) throw not_finite();
    mesh_.locate(position, count, origin);
    total_ = mesh_.total();
    weighed_ = false;
  }

  /// Modes of the number density over its mean, minus 1: zero if particles lie evenly. Throws as fit() does.
  void unevenness(Complex* modes) {
    if (!weighed_) spread_weighed<0>([](Index, Real*) {});
    const auto per_mean = static_cast<Real>(static_cast<double>(grid().point_count()) / static_cast<double>(total_));
    auto& points = transform_.points(1);
#pragma omp parallel for schedule(static) if (grid().point_count() >= parallel_threshold)
    for (int row = 0; row < grid().row_count(); ++row)
      for (int x = 0; x < grid().points[0]; ++x) points.row(0, row)[x] = weight_.row(0, row)[x] * per_mean - Real(1);
    transform_.template to_modes<1>(
        [&](std::size_t n, const WaveVector&, const Complex* mode) { modes[n] = restore_[n] * *mode; });
  }

  /// Computes the kept modes of a field; leaves all others as they are. value(i, numbers) must write its `Count`
  /// components at particle i. The first guess is the weighted mean about each point of the grid, where what spreading
  /// takes from a wave is restored. Then, up to `corrections` times, the same is done with what is still missing at the
  /// particles, and added. So the result comes near the least-squares fit. Throws Error(run_failed) if hardly any
  /// particle is near a point of the grid.
  template <int Count, class Value>
  void fit(const Value& value, const std::array<Complex*, Count>& modes, int corrections) {
    if (weighed_) {
      mesh_.template spread<Count>(value, transform_.points(Count), [&](int row) { divide(row, Count); });
    } else {
      spread_weighed<Count>(value);
    }
    transform_.template to_modes<Count>([&](std::size_t n, const WaveVector&, const Complex* spread) {
      for (int c = 0; c < Count; ++c) modes[c][n] = restore_[n] * spread[c];
    });
    Corrections left(corrections, uneven_);
    while (left.next()) {
      to_points<Count>([&](std::size_t m, const WaveVector&, Complex* numbers) {
        for (int c = 0; c < Count; ++c) numbers[c] = modes[c][m];
      });
      mesh_.template spread_missing<Count>(value, transform_.points(Count), [&](int row) { divide(row, Count); });
      transform_.template to_modes<Count>([&](std::size_t m, const WaveVector&, const Complex* spread) {
        for (int c = 0; c < Count; ++c) modes[c][m] += restore_[m] * spread[c];
      });
    }
  }

  /// Calls take(i, numbers) for every particle, with the values of `Count` fields there. mode(n, k, numbers) must write
  /// their n-th modes, of wave vector k; it is called for the kept modes.
  template <int Count, class Mode, class Take>
  void evaluate(const Mode& mode, const Take& take) {
    to_points<Count>(mode);
    mesh_.template gather<Count>(transform_.points(Count), take);
  }

 private:
  /// Values at the points of which interpolation makes the field of these modes.
  template <int Count, class Mode>
  void to_points(const Mode& mode) {
    transform_.template to_points<Count>([&](std::size_t n, const WaveVector& k, Complex* numbers) {
      mode(n, k, numbers);
      for (int c = 0; c < Count; ++c) numbers[c] *= restore_[n];
    });
  }

  void divide(int row, int count) {
    const Real* const weight = weight_.row(0, row);
    for (int c = 0; c < count; ++c) {
      Real* const to = transform_.points(count).row(c, row);
      for (int x = 0; x < grid().points[0]; ++x) to[x] /= weight[x];
    }
  }

  // Spreads numbers as the first guess of fit(), and on the way finds the weight of the particles near each point, and
  // the unevenness.
  template <int Count, class Value>
  void spread_weighed(const Value& value) {
    const double mean = static_cast<double>(total_) / static_cast<double>(grid().point_count());
    const auto rows = static_cast<std::size_t>(grid().row_count());
    row_squares_.resize(rows);
    row_least_.resize(rows);
    auto& points = transform_.points(Count + 1);
    mesh_.template spread<Count + 1>(
        [&](Index i, Real* numbers) {
          value(i, numbers);
          numbers[Count] = Real(1);
        },
        points,
        [&](int row) {
          const Real* const from = points.row(Count, row);
          std::copy_n(from, grid().points[0], weight_.row(0, row));
          double square = 0.0;
          for (int x = 0; x < grid().points[0]; ++x) square += (double(from[x]) - mean) * (double(from[x]) - mean);
          row_squares_[static_cast<std::size_t>(row)] = square;
          row_least_[static_cast<std::size_t>(row)] = double(*std::min_element(from, from + grid().points[0]));
          divide(row, Count);
        });
    // Row by row, so that the sum is rounded in the same way for any number of threads.
    double square = 0.0;
    for (const double of_row : row_squares_) square += of_row;
    uneven_ = std::sqrt(square / static_cast<double>(grid().point_count())) / mean;
    if (!(*std::min_element(row_least_.begin(), row_least_.end()) > empty_weight * mean)) throw hardly_any_particle();
    weighed_ = true;
  }

  ParticleMesh<Dim, Real> mesh_;
  ModeTransform<Dim, Real> transform_;
  std::vector<double> restore_;  // 1 / (factor by which spreading reduces a wave)
  FieldsOnGrid<Real> weight_;    // of all particles at each point
  std::int64_t total_ = 0;       // particles of all processes
  bool weighed_ = false;
  double uneven_ = 0.0;
  std::vector<double> row_squares_;
  std::vector<double> row_least_;
};

}  // namespace mesogen::mesh
