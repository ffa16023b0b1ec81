#pragma once

#include <array>
#include <span>
#include <vector>

#include "exec/backend.hpp"
#include "ghosts/parts.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "ranks/ranks.hpp"

namespace mesogen {

/// The particles of other ranks of which this one makes ghosts: where they are, and the values of their fields. Found
/// at each sorting; then each rank knows which of its particles which other one asks for.
class MESOGEN_EXPORT Halo {
 public:
  Halo(const Ranks& ranks, const Backend& backend);

  /// `own`: of particles that are stored by cell and were sorted there, in these cells. `reach`: how many rows of cells
  /// a rank looks beyond its own.
  void find(const Parts& parts, const ImageSearch& own, const exec::Array<Index>& cell_of, int reach,
            std::span<const std::int64_t> own_ids);

  /// How many there are.
  [[nodiscard]] Index count() const { return static_cast<Index>(got_.back()); }
  [[nodiscard]] const std::vector<std::int64_t>& ids() const { return ids_; }
  /// m; as bring_positions() left them.
  [[nodiscard]] const exec::AxisArrays<double>& position() const { return position_; }

  /// Brings the positions of all, from those of this rank's particles.
  void bring_positions(const exec::AxisArrays<double>& own, int dimension);
  /// Brings the values of a field: from its own particles to the places of others from `first` on.
  template <class Real>
  void bring(FieldView<Real> field, int components, Index first);

  /// Since the start, by this rank.
  [[nodiscard]] std::int64_t bytes_sent() const { return bytes_sent_; }

 private:
  template <class T>
  struct Buffers {
    explicit Buffers(exec::DeviceMemory* memory) : out(memory), in(memory) {}
    exec::Array<T> out;
    exec::Array<T> in;
  };
  template <class Real>
  [[nodiscard]] Buffers<Real>& buffers() {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return single_;
    } else {
      return double_;
    }
  }
  template <class T>
  void exchange(std::span<const T> out, std::span<T> in, std::size_t components);
  template <class Real>
  void swap(std::span<const Real* const> from, std::span<Real* const> to);

  const Ranks& ranks_;
  const Backend& backend_;
  exec::Array<Index> place_;        // of particles that others ask for, by rank
  std::vector<std::size_t> given_;  // where those of each rank begin among them, one more at the end
  std::vector<std::size_t> got_;    // likewise among those of others
  std::vector<std::int64_t> ids_;
  exec::AxisArrays<double> position_;
  Buffers<float> single_;
  Buffers<double> double_;
  std::int64_t bytes_sent_ = 0;
};

}  // namespace mesogen
