#pragma once

#include <optional>
#include <vector>

#include "mesogen/mesh/device_mesh.hpp"
#include "mesogen/mesh/mode_list.hpp"
#include "mesogen/mesh/ordered_sum.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

template <int Dim, class Action>
struct AtMode {
  ModeList<Dim> list;
  Action action;

  MESOGEN_HOST_DEVICE void operator()(Index j) const {
    const Mode<Dim> mode = list[j];
    action(mode.n, mode.k);
  }
};

template <int Dim, class Term>
struct TermOfMode {
  ModeList<Dim> list;
  Term term;

  MESOGEN_HOST_DEVICE void operator()(Index j, double* sum) const {
    const Mode<Dim> mode = list[j];
    term(mode.n, mode.k, mode.x, *sum);
  }
};

}  // namespace loops

/// Loops over the kept modes where they lie: on the host, or on a device.
template <int Dim>
class ModeLoop {
 public:
  using WaveVector = typename KeptModes<Dim>::WaveVector;

  /// `device`: null on the host.
  explicit ModeLoop(const Grid<Dim>& grid, const DeviceMesh* device = nullptr) : kept_(grid), list_(kept_) {
    if (device == nullptr) return;
    space_ = device->space();
    sum_.emplace(&device->memory());
  }

  [[nodiscard]] const KeptModes<Dim>& kept() const { return kept_; }

  /// Calls action(n, k) for all kept modes, in parallel. As of exec::for_each, `action` must be trivially copyable.
  template <class Action>
  void for_each(const Action& action) const {
    if (sum_) {
      exec::for_each(space_, list_.count(), loops::AtMode<Dim, Action>{list_, action}, "a loop over modes");
    } else {
      kept_.for_each(action);
    }
  }

  /// Adds up over all kept modes, in an order that does not depend on the number of threads. term(n, k, x, sum) must
  /// add to `sum` what belongs to a mode, x-th of its row. Waits for the device.
  template <class Term>
  double sum(const Term& term) {
    return sum_ ? (*sum_)(space_, list_.count(), loops::TermOfMode<Dim, Term>{list_, term})[0] : kept_.sum(term);
  }

 private:
  KeptModes<Dim> kept_;
  ModeList<Dim> list_;
  exec::Space space_;
  std::optional<OrderedSum<1>> sum_;  // on a device
};

}  // namespace mesogen::mesh
