#pragma once

#include <algorithm>

#include "mesogen/mesh/fourier_transform.hpp"
#include "mesogen/mesh/kept_modes.hpp"

namespace mesogen::mesh {

/// Transforms between the kept modes of fields, in double precision, and values at the points of the grid. `Real` is
/// the precision of the values and of the transform.
template <int Dim, class Real>
class ModeTransform {
 public:
  using WaveVector = typename KeptModes<Dim>::WaveVector;

  explicit ModeTransform(const Grid<Dim>& grid)
      : kept_(grid), transform_(grid, kept_.in_row()), points_(grid), modes_(grid) {}

  [[nodiscard]] const KeptModes<Dim>& kept() const { return kept_; }
  /// Values of at least `fields` fields.
  [[nodiscard]] FieldsOnGrid<Real>& points(int fields) {
    points_.hold(fields);
    return points_;
  }

  /// points(x) = sum_k mode(k) exp(i k x), for `Count` fields. mode(n, k, numbers) must write their n-th modes.
  template <int Count, class Mode>
  void to_points(const Mode& mode) {
    points_.hold(Count);
    modes_.hold(Count);
    const int rows = points_.row_count();
    const int in_row = kept_.grid().modes_in_row();
#pragma omp parallel for schedule(static) if (rows * in_row >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      ComplexNumber<Real>* to[Count];
      for (int c = 0; c < Count; ++c) to[c] = modes_.modes(c, row);
      kept_.for_each_in_row(row, [&](std::size_t n, const WaveVector& k, int x) {
        Complex numbers[Count];
        mode(n, k, numbers);
        for (int c = 0; c < Count; ++c) to[c][x] = ComplexNumber<Real>(numbers[c]);
      });
      for (int c = 0; c < Count; ++c) std::fill(to[c] + kept_.in_row(row), to[c] + in_row, ComplexNumber<Real>(0));
    }
    transform_.backward(modes_, points_, Count);
  }

  /// Calls take(n, k, numbers) for all kept modes of the first `Count` fields at the points, in parallel.
  template <int Count, class Take>
  void to_modes(const Take& take) {
    modes_.hold(Count);
    transform_.forward(points_, modes_, Count);
    const int rows = points_.row_count();
#pragma omp parallel for schedule(static) if (rows * kept_.in_row() >= parallel_threshold)
    for (int row = 0; row < rows; ++row)
      kept_.for_each_in_row(row, [&](std::size_t n, const WaveVector& k, int x) {
        Complex numbers[Count];
        for (int c = 0; c < Count; ++c) numbers[c] = Complex(modes_.modes(c, row)[x]);
        take(n, k, numbers);
      });
  }

  /// Makes room for the values of so many fields.
  void hold_points(int fields) { points_.hold(fields); }
  /// Calls change(before, after) for every point: it must write, from the numbers that the first `From` fields have
  /// there, those that the first `To` fields get. There must be room for them, see hold_points().
  template <int From, int To, class Change>
  void change_points(const Change& change) {
    const int rows = points_.row_count();
    const int columns = kept_.grid().points[0];
#pragma omp parallel for schedule(static) if (rows * columns >= parallel_threshold)
    for (int row = 0; row < rows; ++row) {
      Real* at[std::max(From, To)];
      for (int c = 0; c < std::max(From, To); ++c) at[c] = points_.row(c, row);
      for (int x = 0; x < columns; ++x) {
        Real before[From];
        Real after[To];
        for (int c = 0; c < From; ++c) before[c] = at[c][x];
        change(before, after);
        for (int c = 0; c < To; ++c) at[c][x] = after[c];
      }
    }
  }

 private:
  KeptModes<Dim> kept_;
  FourierTransform<Real> transform_;
  FieldsOnGrid<Real> points_;
  FieldsOnGrid<Real> modes_;
};

}  // namespace mesogen::mesh
