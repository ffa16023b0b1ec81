#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// All particles of a run and what they carry, as readers see them: observers, frames, checkpoints. In a run on one
/// process that is its state itself. Where ranks share a run, the first one gathers it, rank by rank in their orders of
/// storage; on the others it is empty.
class MESOGEN_EXPORT WholeState {
 public:
  /// The state must outlive it.
  explicit WholeState(const State& state) : state_(state) {}

  /// Gathers the particles and these fields, as far as they have changed since; all ranks together.
  void gather(const std::vector<std::string>& fields);

  [[nodiscard]] const Particles& particles() const { return gathers() ? particles_ : state_.particles; }
  [[nodiscard]] const FieldStore& fields() const { return gathers() ? fields_ : state_.fields; }
  /// Where they lie.
  [[nodiscard]] const Backend& backend() const { return gathers() ? Backend::host() : state_.backend; }

 private:
  [[nodiscard]] bool gathers() const { return state_.ranks.several(); }
  void gather_particles();
  void gather(const Field& field);

  const State& state_;
  Particles particles_;
  FieldStore fields_;
  std::uint64_t order_ = 0;  // version of the order of storage that the particles are in
  /// Versions of a field and of the order of storage.
  struct Gathered {
    std::uint64_t field = 0;
    std::uint64_t order = 0;
  };
  std::map<std::string, Gathered> gathered_;
};

}  // namespace mesogen
