#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "exec/work_clock.hpp"
#include "ghosts/neighbourhood.hpp"
#include "ghosts/rule_table.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"
#include "particles/field.hpp"

namespace mesogen {

/// What fields are at ghosts and at particles of walls, by the rules of the boundary.
///
/// A ghost takes the value of its source. A wall particle takes that at its mirror point, interpolated from particles
/// and ghosts with weights that depend on positions alone: found once for all fields, whenever particles have moved.
class MESOGEN_EXPORT BoundaryValues {
 public:
  /// All of these must outlive it.
  BoundaryValues(const Scene& scene, const Boundary& boundary, Neighbourhood& neighbourhood,
                 const sph::SmoothingKernel& kernel, const WorkClock& clock, const Ranks& ranks)
      : scene_(scene),
        boundary_(boundary),
        neighbourhood_(neighbourhood),
        kernel_(kernel),
        clock_(clock),
        ranks_(ranks),
        linear_(clock.backend.memory()),
        curved_(clock.backend.memory()) {}

  /// Brings a field up to date there, if it is not.
  void refresh(Field& field);

  /// What this took.
  [[nodiscard]] const Counter& counter() const { return refreshing_; }

 private:
  [[nodiscard]] bool up_to_date(const Field& field) const;
  [[nodiscard]] std::uint64_t positions() const;
  struct Rules {
    /// Values that stay the same.
    explicit Rules(exec::DeviceMemory* memory)
        : ghosts({}, memory), walls({}, memory), curved(memory), at_wall(memory) {}
    RuleTable ghosts;
    RuleTable walls;
    exec::Array<std::uint8_t> curved;  ///< by wall particle; empty where the field is curved at none
    exec::Array<double> at_wall;       ///< by wall particle, then component; likewise
    bool vector = false;               ///< the field is a vector
    bool straight_somewhere = true;    ///< there is a wall particle at which the field is not curved
  };
  const Rules& rules_of(const Field& field);
  [[nodiscard]] Rules ask(const FieldKind& field, bool difference) const;
  template <class Real>
  void refresh_ghosts(Field& field);
  template <class Real, int Dim>
  void refresh_walls(Field& field);

  const Scene& scene_;
  const Boundary& boundary_;
  Neighbourhood& neighbourhood_;
  const sph::SmoothingKernel& kernel_;
  const WorkClock& clock_;
  const Ranks& ranks_;
  std::uint64_t walls_version_ = 0;
  std::map<std::string, Rules, std::less<>> rules_;  // by field
  /// See sph/mirror_values.hpp.
  struct Weights {
    explicit Weights(exec::DeviceMemory* memory) : values(memory) {}
    exec::Array<double> values;
    std::uint64_t version = 0;  ///< of the neighbourhood that they belong to
  };
  template <class Real, int Dim>
  const double* find(sph::MirrorFit fit, Weights& weights);
  Weights linear_;
  Weights curved_;
  Counter refreshing_{"framework: values beyond the faces"};
};

}  // namespace mesogen
