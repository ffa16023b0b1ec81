#pragma once

#include "mesogen/exec/array.hpp"
#include "mesogen/mesh/device_mesh.hpp"

namespace mesogen {

/// What a CUDA device offers a mesh: CUB sorts, cuFFT transforms.
class CudaMesh final : public mesh::DeviceMesh {
 public:
  CudaMesh(const exec::Space& space, exec::DeviceMemory& memory)
      : space_(space), memory_(memory), places_(&memory), scratch_(&memory) {}

  [[nodiscard]] exec::Space space() const override { return space_; }
  [[nodiscard]] exec::DeviceMemory& memory() const override { return memory_; }
  void sort(const Index* key, Index count, Index keys, Index* sorted, Index* order) const override;

 protected:
  [[nodiscard]] std::unique_ptr<mesh::DeviceTransform<float>> single_transform(const std::array<int, 3>& points,
                                                                               int dimension) const override;
  [[nodiscard]] std::unique_ptr<mesh::DeviceTransform<double>> double_transform(const std::array<int, 3>& points,
                                                                                int dimension) const override;

 private:
  exec::Space space_;
  exec::DeviceMemory& memory_;
  mutable exec::Array<Index> places_;
  mutable exec::Array<std::byte> scratch_;
};

}  // namespace mesogen
