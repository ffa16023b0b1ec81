#include "backend/host_loops.hpp"

namespace mesogen {

namespace {

class HostBackend final : public exec::BackendImpl {
 public:
  HostBackend() : BackendImpl(exec::Space{}), cells_(reductions()) {}
  [[nodiscard]] std::string device() const override { return {}; }
  [[nodiscard]] exec::DeviceMemory* memory() const override { return nullptr; }
  [[nodiscard]] bool has_host_code() const override { return true; }
  void finish() const override {}
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }
  [[nodiscard]] const mesh::DeviceMesh* mesh() const override { return nullptr; }

 private:
  exec::HostCellLoops cells_;
};

}  // namespace

Backend::~Backend() = default;

const Backend& Backend::host() {
  static const HostBackend backend;
  return backend;
}

}  // namespace mesogen
