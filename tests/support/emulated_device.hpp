#pragma once

#include <functional>
#include <memory>
#include <string>

#include "backend/host_loops.hpp"
#include "case_text.hpp"
#include "exec/emulated_memory.hpp"
#include "mesh/emulated_mesh.hpp"
#include "run/setup.hpp"

namespace mesogen::test {

/// A device that the host plays: the host's own loops, memory apart, what is out of date poisoned. A run has the bits
/// of a run on the host, and whoever forgets to ask for the newest values computes with what is not a number. Needs no
/// nvcc.
class EmulatedDevice final : public exec::BackendImpl {
 public:
  /// `host_code`: as code of the host is, it goes by blocks. Otherwise neighbours and values at walls go by runs; sums
  /// over pairs, which only nvcc compiles for runs, cannot be asked for then.
  explicit EmulatedDevice(exec::EmulatedMemory& memory, bool host_code = true)
      : BackendImpl(exec::Space{}), memory_(memory), host_code_(host_code), cells_(reductions()), mesh_(memory) {}

  [[nodiscard]] std::string device() const override { return "the host, for a test"; }
  [[nodiscard]] exec::DeviceMemory* memory() const override { return &memory_; }
  [[nodiscard]] bool has_host_code() const override { return host_code_; }
  void finish() const override {}
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }
  [[nodiscard]] const mesh::DeviceMesh* mesh() const override { return &mesh_; }

  /// What a setup takes to run there: `on_device` tells of each physics plugin whether its passes do.
  [[nodiscard]] SetupAdditions additions(std::function<bool(const std::string& type)> on_device) const {
    return {.scene = {},
            .fields =
                [this, on_device = std::move(on_device)](Setup& setup) {
                  setup.backend = this;
                  for (auto& member : setup.physics) member.on_device = on_device(member.type);
                },
            .readers = {}};
  }

 private:
  exec::EmulatedMemory& memory_;
  bool host_code_;
  exec::HostCellLoops cells_;
  mesh::EmulatedMesh mesh_;
};

/// A run that may be put on such a device.
inline std::unique_ptr<Setup> put_together(const CaseText& text, const PluginRegistry& registry,
                                           const SetupAdditions& additions) {
  Problems problems;
  return set_up(read_case_text(text.text(), "test.toml", {}, problems), registry, problems, additions);
}

}  // namespace mesogen::test
