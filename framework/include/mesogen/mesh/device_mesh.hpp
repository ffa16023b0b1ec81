#pragma once

#include <array>
#include <memory>
#include <type_traits>

#include "mesogen/exec/device_memory.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/export.hpp"
#include "mesogen/mesh/complex.hpp"
#include "mesogen/mesh/grid.hpp"

namespace mesogen::mesh {

/// Fourier transforms of real fields on a device, not divided by the number of points. All numbers lie in the memory of
/// the device: field after field, each row by row along the first axis without gaps, of points or of
/// Grid::modes_in_row() modes. Results have the same bits in every run.
template <class Real>
class MESOGEN_EXPORT DeviceTransform {
 public:
  DeviceTransform() = default;
  DeviceTransform(const DeviceTransform&) = delete;
  DeviceTransform& operator=(const DeviceTransform&) = delete;
  virtual ~DeviceTransform();

  /// modes(k) = sum_x points(x) exp(-i k x)
  virtual void forward(const Real* points, ComplexNumber<Real>* modes, int fields) = 0;
  /// points(x) = sum_k modes(k) exp(i k x). What `modes` hold is lost.
  virtual void backward(ComplexNumber<Real>* modes, Real* points, int fields) = 0;
};

/// What a mesh on a device needs beside loops: memory, sorting and Fourier transforms. A backend offers it; a pass gets
/// it from PassContext::device_mesh().
class MESOGEN_EXPORT DeviceMesh {
 public:
  DeviceMesh() = default;
  DeviceMesh(const DeviceMesh&) = delete;
  DeviceMesh& operator=(const DeviceMesh&) = delete;
  virtual ~DeviceMesh();

  [[nodiscard]] virtual exec::Space space() const = 0;
  [[nodiscard]] virtual exec::DeviceMemory& memory() const = 0;

  /// Sorts i in [0, count) by key[i] in [0, keys): writes the sorted keys, and the order[n] = i that belong to them.
  /// Where keys are equal the order of i stays. All pointers are valid on the device.
  virtual void sort(const Index* key, Index count, Index keys, Index* sorted, Index* order) const = 0;

  template <class Real, int Dim>
  [[nodiscard]] std::unique_ptr<DeviceTransform<Real>> transform(const Grid<Dim>& grid) const {
    std::array<int, 3> points{1, 1, 1};
    for (int d = 0; d < Dim; ++d) points[d] = grid.points[d];
    if constexpr (std::is_same_v<Real, float>) {
      return single_transform(points, Dim);
    } else {
      return double_transform(points, Dim);
    }
  }

 protected:
  /// `points`: along the first axis, the second, the third; 1 beyond the `dimension` that there are.
  [[nodiscard]] virtual std::unique_ptr<DeviceTransform<float>> single_transform(const std::array<int, 3>& points,
                                                                                 int dimension) const = 0;
  [[nodiscard]] virtual std::unique_ptr<DeviceTransform<double>> double_transform(const std::array<int, 3>& points,
                                                                                  int dimension) const = 0;
};

}  // namespace mesogen::mesh
