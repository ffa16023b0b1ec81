#pragma once

#include "mesogen/mesh/device_mesh.hpp"

namespace mesogen::mesh {

/// A device that is played by the host, for tests where there is no device: transforms by FFTW.
class MESOGEN_EXPORT EmulatedMesh final : public DeviceMesh {
 public:
  explicit EmulatedMesh(exec::DeviceMemory& memory) : memory_(memory) {}

  [[nodiscard]] exec::Space space() const override { return {}; }
  [[nodiscard]] exec::DeviceMemory& memory() const override { return memory_; }
  void sort(const Index* key, Index count, Index keys, Index* sorted, Index* order) const override;

 protected:
  [[nodiscard]] std::unique_ptr<DeviceTransform<float>> single_transform(const std::array<int, 3>& points,
                                                                         int dimension) const override;
  [[nodiscard]] std::unique_ptr<DeviceTransform<double>> double_transform(const std::array<int, 3>& points,
                                                                          int dimension) const override;

 private:
  exec::DeviceMemory& memory_;
};

}  // namespace mesogen::mesh
