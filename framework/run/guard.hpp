#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/state.hpp"
#include "schedule/step_graph.hpp"
#include "time/integrator.hpp"
#include "time/step_control.hpp"

namespace mesogen {

/// Ends a run that is broken, with the particle, the field, its value and bound, the time and a remedy. It
/// only looks: a guarded run has the bits of an unguarded one.
///
/// Its bounds are those that no sound run meets: particle volumes stay within some 5 % of the lattice's (after a start
/// jittered by half a spacing they begin at half of it), speeds below the fifth of a spacing in a step that step
/// control allows.
class MESOGEN_EXPORT Guard {
 public:
  /// All of these must outlive it.
  Guard(State& state, const Catalogue& catalogue, const StepGraph& graph, const Integrator& integrator,
        const StepControl& control);

  /// At the end of a step, before the backend waits for what it finds: looks for values out of their bounds.
  void look();
  /// After that. Throws Error(run_failed).
  void check(const Motion& motion) const;
  /// Of it, whether what is advanced is finite.
  void check_finite(const Motion& motion) const;

 private:
  struct Guarded {
    Field* field;
    FieldBounds bounds;
    bool prescribed;  ///< by the case
  };

  void check_prescribed() const;
  void check_speed(const Motion& motion) const;
  void check_step(const Motion& motion) const;
  void check_distances() const;
  [[noreturn]] void stop_at_field(const Guarded& guarded) const;
  [[noreturn]] void stop_at_volume() const;
  /// What to do where particles are too fast, or lie unevenly.
  [[nodiscard]] std::string calmer() const;
  [[nodiscard]] std::int64_t id_at(Index place) const;
  [[nodiscard]] std::string particle(Index place) const;
  [[nodiscard]] std::string unit(std::string_view declared) const { return state_.units.text(declared); }
  /// `excess`: how bad it is on this rank.
  [[noreturn]] void stop(const std::string& what, const std::string& remedy, double excess) const;

  State& state_;
  const Integrator& integrator_;
  const StepControl& control_;
  std::vector<Guarded> fields_;
  bool looks_for_pairs_ = false;          ///< particles move, and pairs are summed over
  Field* volume_ = nullptr;               ///< null if it is not made anew at each step
  std::vector<exec::Reduction> outside_;  ///< of each of the fields, and of the volume: is something outside?
  double lattice_volume_;                 ///< of a particle on the lattice as `volume` measures it, m^Dim
};

}  // namespace mesogen
