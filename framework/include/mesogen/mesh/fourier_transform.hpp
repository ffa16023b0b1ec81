#pragma once

#include <array>
#include <complex>
#include <memory>

#include "mesogen/export.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

using Complex = std::complex<double>;

/// The discrete Fourier transform of real periodic fields in one to three dimensions, by FFTW. Threads share the lines,
/// and each line is transformed by itself. Results are the same bits for any number of threads, and in every run.
class MESOGEN_EXPORT FourierTransform {
 public:
  template <int Dim>
  explicit FourierTransform(const Grid<Dim>& grid) : FourierTransform(in_three(grid), Dim) {}
  FourierTransform(std::array<int, 3> points, int dimension);
  FourierTransform(const FourierTransform&) = delete;
  FourierTransform& operator=(const FourierTransform&) = delete;
  ~FourierTransform();

  /// modes(k) = 1/N sum_x values(x) exp(-i k x). Writes Grid::mode_count() modes.
  void forward(const double* values, Complex* modes);
  /// values(x) = sum_k modes(k) exp(i k x). Overwrites `modes`, which hold nothing of use afterwards.
  void backward(Complex* modes, double* values);

 private:
  template <int Dim>
  static std::array<int, 3> in_three(const Grid<Dim>& grid) {
    std::array<int, 3> points{1, 1, 1};
    for (int d = 0; d < Dim; ++d) points[d] = grid.points[d];
    return points;
  }

  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace mesogen::mesh
