#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "exec/work_clock.hpp"
#include "ghosts/neighbourhood.hpp"
#include "mesogen/export.hpp"
#include "particles/field.hpp"
#include "particles/particles.hpp"
#include "ranks/journey.hpp"

namespace mesogen {

/// Keeps particles, their fields and their neighbours in one order of storage, that of the cells.
///
/// The integration alone decides when particles are sorted. A reader (an observer, a frame) may need them sorted at
/// another moment; the order that the integration had is kept then, and comes back before it goes on.
class MESOGEN_EXPORT ParticleOrder {
 public:
  /// All of these must outlive it.
  ParticleOrder(Particles& particles, Neighbourhood& neighbourhood, FieldStore& fields, const WorkClock& clock,
                const Ranks& ranks)
      : particles_(particles),
        neighbourhood_(neighbourhood),
        fields_(fields),
        clock_(clock),
        ranks_(ranks),
        scratch_(clock.backend.memory()) {}

  /// To be called whenever positions changed. `farthest`: no particle is now farther than this from where it was
  /// sorted, m.
  void mark_moved(double farthest = nobody_knows) {
    moved_ = true;
    farthest_ = farthest;
    ++version_;
  }
  /// Moves particles, by arguments of exec::FieldLoops::move, none of them farther than `farthest` from where it was
  /// sorted.
  template <class Real, template <class> class Arguments>
  void move(const Arguments<Real>& arguments, double farthest);
  /// To be called when it becomes known how far that is, if it was not at once.
  void note_farthest(double farthest) { farthest_ = farthest; }
  /// Raised whenever particles have moved or changed places in storage.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// Are neighbours up to date with the positions?
  [[nodiscard]] bool settled() const { return !moved_; }

  /// Brings neighbours up to date with the positions: sorts, if need be, and every field into the new order.
  void settle();
  /// The same for a reader, who must leave no trace in the integration. If particles have to be sorted for it, the
  /// order of storage that the integration had is kept, with the positions as they were (sorting takes particles that
  /// left the box back inside, which rounds).
  void settle_for_reader();
  /// Returns to the order of the integration, if a reader had particles sorted. To be called before particles change,
  /// and before a checkpoint.
  void return_to_integration();

  /// Stores particles by cell, and those inside that have left the box, for who needs no neighbours: near in space is
  /// near in memory. Leaves neighbours out of date.
  void sort_for_memory();
  /// Sorts whether or not it must be.
  void sort_anew();
  /// Sorts as a checkpoint says; see Neighbourhood::restore.
  void restore(const std::array<std::vector<double>, 3>& sorted_position);

  /// What this took.
  [[nodiscard]] const Counter& counter() const { return sorting_; }

 private:
  void resize_fields();
  void permute_fields(const exec::Array<Index>& order);
  void permute(const exec::Array<Index>& order);
  void changed_places();
  void travel();
  void carry_fields(const Journey& journey, bool back);
  void keep();
  /// The order of storage that the integration had before a reader's sorting.
  struct Kept {
    Particles particles;
    std::array<std::vector<double>, 3> sorted_position;
    exec::Array<Index> way_back;     // a permutation
    std::optional<Journey> journey;  // before it
  };

  Particles& particles_;
  Neighbourhood& neighbourhood_;
  FieldStore& fields_;
  const WorkClock& clock_;
  const Ranks& ranks_;
  static constexpr double nobody_knows = std::numeric_limits<double>::infinity();

  bool moved_ = true;
  double farthest_ = nobody_knows;
  std::uint64_t version_ = 1;
  std::optional<Kept> kept_;
  Field::Scratch scratch_;
  Counter sorting_{"framework: neighbours, sorting"};
};

}  // namespace mesogen
