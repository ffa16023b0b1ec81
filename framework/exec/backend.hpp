#pragma once

#include <span>
#include <string>
#include <type_traits>

#include "mesogen/exec/device_memory.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

namespace mesh {
class DeviceMesh;  // mesogen/mesh/device_mesh.hpp
}

namespace exec {

/// A number that a loop looks for. Backend::found() tells it, after Backend::wait().
struct Reduction {
  int place = 0;
  [[nodiscard]] Reduction next() const { return {place + 1}; }
};

// The framework's own loops, each declared with what it is about. They are written once, as functors; each backend
// compiles them for where it runs, and they take pointers that are valid there.
class StorageLoops;  // particles/storage_loops.hpp
class CellLoops;     // neighbours/cell_loops.hpp
class GhostLoops;    // ghosts/ghost_loops.hpp
template <class Real>
class FieldLoops;  // particles/field_loops.hpp
template <class Real>
class PairLoops;  // sph/pair_loops.hpp
template <class Real>
class MirrorLoops;  // sph/mirror_loops.hpp

}  // namespace exec

/// Where a run computes: the host, or a CUDA device. Work on a device is only asked for; arrays (exec/array.hpp) wait
/// for it where the host reads them. One for the process: runs that share it take turns.
class MESOGEN_EXPORT Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend();

  /// "NVIDIA H200"; empty on the host.
  [[nodiscard]] virtual std::string device() const = 0;
  /// What a device's code is compiled for, "sm_90": bits of results differ between such. Empty on the host.
  [[nodiscard]] virtual std::string architecture() const { return {}; }
  [[nodiscard]] bool on_host() const { return device().empty(); }
  [[nodiscard]] virtual exec::Space space() const = 0;
  /// What arrays are made with: null on the host, where there is no other memory.
  [[nodiscard]] virtual exec::DeviceMemory* memory() const = 0;
  /// Are its loops compiled as code of the host is? Then pair sums go by blocks of neighbours, otherwise by runs.
  [[nodiscard]] virtual bool has_host_code() const = 0;
  /// Waits until all that was asked for is done. Throws Error(run_failed) if some of it failed. Used to measure
  /// the time of work and to find errors where they arise. Arrays wait by themselves where results are read.
  virtual void finish() const = 0;
  /// The same, and brings the results of reductions.
  virtual void wait() const = 0;
  [[nodiscard]] virtual double found(exec::Reduction reduction) const = 0;
  /// The results of all reductions that it has room for, where ranks put what all of them found.
  [[nodiscard]] virtual std::span<double> all_found() const = 0;

  [[nodiscard]] virtual const exec::StorageLoops& storage() const = 0;
  [[nodiscard]] virtual const exec::CellLoops& cells() const = 0;
  [[nodiscard]] virtual const exec::GhostLoops& ghosts() const = 0;
  template <class Real>
  [[nodiscard]] const exec::FieldLoops<Real>& fields() const {
    if constexpr (std::is_same_v<Real, float>) {
      return single_fields();
    } else {
      return double_fields();
    }
  }
  template <class Real>
  [[nodiscard]] const exec::PairLoops<Real>& pairs() const {
    if constexpr (std::is_same_v<Real, float>) {
      return single_pairs();
    } else {
      return double_pairs();
    }
  }
  /// Of the points in which wall particles are mirrored.
  template <class Real>
  [[nodiscard]] const exec::MirrorLoops<Real>& mirrors() const {
    if constexpr (std::is_same_v<Real, float>) {
      return single_mirrors();
    } else {
      return double_mirrors();
    }
  }

  /// What it offers a mesh beside the particles; null on the host.
  [[nodiscard]] virtual const mesh::DeviceMesh* mesh() const = 0;

  static const Backend& host();

 protected:
  [[nodiscard]] virtual const exec::FieldLoops<float>& single_fields() const = 0;
  [[nodiscard]] virtual const exec::FieldLoops<double>& double_fields() const = 0;
  [[nodiscard]] virtual const exec::PairLoops<float>& single_pairs() const = 0;
  [[nodiscard]] virtual const exec::PairLoops<double>& double_pairs() const = 0;
  [[nodiscard]] virtual const exec::MirrorLoops<float>& single_mirrors() const = 0;
  [[nodiscard]] virtual const exec::MirrorLoops<double>& double_mirrors() const = 0;
};

}  // namespace mesogen
