#pragma once

#include <array>
#include <memory>

#include "mesogen/export.hpp"
#include "mesogen/mesh/fields_on_grid.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// The discrete Fourier transform of real periodic fields in one to three dimensions, by FFTW, in single or double
/// precision. Threads share the lines, and each line is transformed by itself. Results are the same bits for any number
/// of threads, and in every run.
template <class Real>
class MESOGEN_EXPORT FourierTransform {
 public:
  /// Only the first `kept` modes of each row are transformed; without it, all Grid::modes_in_row().
  template <int Dim>
  explicit FourierTransform(const Grid<Dim>& grid, int kept)
      : FourierTransform(in_three(grid), Dim, kept, FieldsOnGrid<Real>(grid, 1)) {}
  template <int Dim>
  explicit FourierTransform(const Grid<Dim>& grid) : FourierTransform(grid, grid.modes_in_row()) {}
  FourierTransform(const FourierTransform&) = delete;
  FourierTransform& operator=(const FourierTransform&) = delete;
  ~FourierTransform();

  /// modes(k) = 1/N sum_x values(x) exp(-i k x), for the first `fields` fields. Modes that are not kept hold nothing of
  /// use afterwards.
  void forward(const FieldsOnGrid<Real>& values, FieldsOnGrid<Real>& modes, int fields);
  /// values(x) = sum_k modes(k) exp(i k x), for the first `fields` fields. Modes that are not kept must be zero.
  /// Overwrites `modes`, which hold nothing of use afterwards.
  void backward(FieldsOnGrid<Real>& modes, FieldsOnGrid<Real>& values, int fields);

 private:
  FourierTransform(std::array<int, 3> points, int dimension, int kept, FieldsOnGrid<Real> room);

  template <int Dim>
  static std::array<int, 3> in_three(const Grid<Dim>& grid) {
    std::array<int, 3> points{1, 1, 1};
    for (int d = 0; d < Dim; ++d) points[d] = grid.points[d];
    return points;
  }

  struct Plans;
  std::unique_ptr<Plans> plans_;
};

extern template class FourierTransform<float>;
extern template class FourierTransform<double>;

}  // namespace mesogen::mesh
