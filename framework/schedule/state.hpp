#pragma once

#include <cstdint>
#include <string>

#include "case/units.hpp"
#include "exec/backend.hpp"
#include "exec/work_clock.hpp"
#include "ghosts/boundary_values.hpp"
#include "ghosts/neighbourhood.hpp"
#include "ghosts/particle_order.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"
#include "particles/field.hpp"
#include "particles/particles.hpp"

namespace mesogen {

/// The state of a run, which passes work on: where the particles are, what they carry, and when it is.
struct MESOGEN_EXPORT State {
  /// The arrays of the particles are made with the backend's memory.
  State(Scene scene, sph::SmoothingKernel kernel, const Boundary& boundary, Particles particles,
        const Backend& backend = Backend::host(), const Ranks& ranks = Ranks::alone());
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  const Scene scene;
  const sph::SmoothingKernel kernel;
  const Boundary& boundary;
  const Backend& backend;
  const Ranks& ranks;  ///< that share the run; particles and fields are those of this one
  WorkClock clock;
  Particles particles;
  Neighbourhood neighbourhood;
  FieldStore fields;
  ParticleOrder order;             ///< in which particles, neighbours and fields are stored
  BoundaryValues boundary_values;  ///< of fields, at ghosts and walls
  Units units;                     ///< of the case, for messages
  double time = 0.0;               ///< s
  double step_size = 0.0;          ///< s; 0 when rates are evaluated without a step
  std::int64_t step = 0;           ///< steps done

  /// Room for those who read values of a few particles at every step.
  struct Chosen {
    explicit Chosen(exec::DeviceMemory* memory) : place(memory), value(memory) {}
    exec::Array<Index> place;
    exec::Array<double> value;
  };
  mutable Chosen chosen;

  /// Waits for what was asked for (Backend::wait). What loops looked for is then the largest of all ranks.
  void wait() const;
  [[nodiscard]] bool single() const { return scene.precision == Precision::single_precision; }

  Field& add_field(const std::string& name, int components, bool integrated);
  /// Room for the doubles of an integrated field at another time; kept in order as all fields are.
  Field& add_copy_in_double(const Field& of);
  /// A field of doubles of the framework's own.
  Field& add_in_double(const std::string& name, int components);
};

}  // namespace mesogen
