#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

#include "mesogen/mesh/complex.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Numbers of several fields at the points of a grid, or their Fourier modes, row by row along the first axis. A row
/// has room for `beyond` more numbers than there are points: for the last mode, and for the first points once more.
/// Rows begin at cache lines, so that transforms can use SIMD, and are an odd number of cache lines apart, so that
/// the points of a column do not compete for the same places of a cache.
template <class Real>
class FieldsOnGrid {
 public:
  static constexpr int beyond = 4;

  template <int Dim>
  explicit FieldsOnGrid(const Grid<Dim>& grid, int fields = 0)
      : rows_(grid.row_count()), stride_(stride_of(grid.points[0])) {
    hold(fields);
  }

  /// Bytes that a field takes.
  template <int Dim>
  static double bytes(const Grid<Dim>& grid) {
    return static_cast<double>(sizeof(Real)) * static_cast<double>(grid.row_count()) *
           static_cast<double>(stride_of(grid.points[0]));
  }

  /// Makes room for so many fields. Where there was less, all numbers are zero afterwards.
  void hold(int fields) {
    if (fields <= fields_) return;
    fields_ = fields;
    const auto count = static_cast<std::size_t>(fields * field_stride());
    numbers_.reset(static_cast<Real*>(::operator new[](count * sizeof(Real), alignment)));
    std::fill(numbers_.get(), numbers_.get() + count, Real(0));
  }

  [[nodiscard]] int row_count() const { return rows_; }
  /// From one row to the next, and from one field to the next, in numbers.
  [[nodiscard]] std::ptrdiff_t row_stride() const { return stride_; }
  [[nodiscard]] std::ptrdiff_t field_stride() const { return stride_ * rows_; }

  [[nodiscard]] Real* row(int field, int row) { return numbers_.get() + field * field_stride() + row * stride_; }
  [[nodiscard]] const Real* row(int field, int row) const {
    return numbers_.get() + field * field_stride() + row * stride_;
  }
  /// The same row, where it holds modes.
  [[nodiscard]] ComplexNumber<Real>* modes(int field, int row) {
    return reinterpret_cast<ComplexNumber<Real>*>(this->row(field, row));
  }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(Real* numbers) const { ::operator delete[](numbers, alignment); }
  };

  static std::ptrdiff_t stride_of(int points) {
    constexpr auto in_line = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(alignment) / sizeof(Real));
    return ((points + beyond + in_line - 1) / in_line | 1) * in_line;
  }

  int rows_;
  std::ptrdiff_t stride_;
  int fields_ = 0;
  std::unique_ptr<Real[], Free> numbers_;
};

}  // namespace mesogen::mesh
