#include "mesh/emulated_mesh.hpp"

#include <algorithm>

#include "mesogen/exec/counting_sort.hpp"
#include "mesogen/mesh/fourier_transform.hpp"

namespace mesogen::mesh {

namespace {

/// Field by field, by way of rows as the transform of the host wants them.
template <class Real>
class EmulatedTransform final : public DeviceTransform<Real> {
 public:
  explicit EmulatedTransform(const Grid<3>& grid) : grid_(grid), transform_(grid), points_(grid, 1), modes_(grid, 1) {}

  void forward(const Real* points, ComplexNumber<Real>* modes, int fields) override {
    const auto all = static_cast<Real>(grid_.point_count());
    for (int field = 0; field < fields; ++field) {
      for (int row = 0; row < grid_.row_count(); ++row, points += grid_.points[0])
        std::copy_n(points, grid_.points[0], points_.row(0, row));
      transform_.forward(points_, modes_, 1);
      for (int row = 0; row < grid_.row_count(); ++row)
        for (int x = 0; x < grid_.modes_in_row(); ++x) *modes++ = all * modes_.modes(0, row)[x];
    }
  }
  void backward(ComplexNumber<Real>* modes, Real* points, int fields) override {
    for (int field = 0; field < fields; ++field) {
      for (int row = 0; row < grid_.row_count(); ++row, modes += grid_.modes_in_row())
        std::copy_n(modes, grid_.modes_in_row(), modes_.modes(0, row));
      transform_.backward(modes_, points_, 1);
      for (int row = 0; row < grid_.row_count(); ++row, points += grid_.points[0])
        std::copy_n(points_.row(0, row), grid_.points[0], points);
    }
  }

 private:
  Grid<3> grid_;
  FourierTransform<Real> transform_;
  FieldsOnGrid<Real> points_;
  FieldsOnGrid<Real> modes_;
};

template <class Real>
std::unique_ptr<DeviceTransform<Real>> emulated(const std::array<int, 3>& points) {
  return std::make_unique<EmulatedTransform<Real>>(Grid<3>{points, {1.0, 1.0, 1.0}});
}

}  // namespace

template <class Real>
DeviceTransform<Real>::~DeviceTransform() = default;
template class DeviceTransform<float>;
template class DeviceTransform<double>;

DeviceMesh::~DeviceMesh() = default;

void EmulatedMesh::sort(const Index* key, Index count, Index keys, Index* sorted, Index* order) const {
  (void)exec::counting_sort(
      count, static_cast<std::size_t>(keys), [&](Index i) { return key[i]; },
      [&](Index i, Index to) {
        sorted[to] = key[i];
        order[to] = i;
      });
}

std::unique_ptr<DeviceTransform<float>> EmulatedMesh::single_transform(const std::array<int, 3>& points, int) const {
  return emulated<float>(points);
}
std::unique_ptr<DeviceTransform<double>> EmulatedMesh::double_transform(const std::array<int, 3>& points, int) const {
  return emulated<double>(points);
}

}  // namespace mesogen::mesh
