#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "case/units.hpp"
#include "diagnostics/trace.hpp"
#include "exec/backend.hpp"
#include "ghosts/boundary_values.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/kernel_function.hpp"
#include "neighbours/neighbourhood.hpp"
#include "particles/field.hpp"
#include "particles/particles.hpp"

namespace mesogen {

/// The state of a run: where the particles are, what they carry, and when it is.
class MESOGEN_EXPORT State {
 public:
  /// The arrays of the particles are made with the backend's memory.
  State(Scene scene, sph::SmoothingKernel kernel, const Boundary& boundary, Particles particles,
        const Backend& backend = Backend::host());
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  const Scene scene;
  const sph::SmoothingKernel kernel;
  const Boundary& boundary;
  const Backend& backend;
  Particles particles;
  Neighbourhood neighbourhood;
  FieldStore fields;
  Units units;              ///< of the case, for messages
  double time = 0.0;        ///< s
  double step_size = 0.0;   ///< s; 0 when rates are evaluated without a step
  std::int64_t step = 0;    ///< steps done
  Trace* trace = nullptr;   ///< of what is done here, if one is asked for; must outlive that
  bool times_each = false;  ///< is a device waited for after each piece of work, so that its time is told?

  [[nodiscard]] bool single() const { return scene.precision == Precision::single_precision; }

  Field& add_field(const std::string& name, int components, bool integrated);
  /// Room for the doubles of an integrated field at another time; kept in order as all fields are.
  Field& add_copy_in_double(const Field& of);
  /// A field of doubles of the framework's own.
  Field& add_in_double(const std::string& name, int components);
  /// To be called whenever positions changed.
  void mark_moved() {
    moved_ = true;
    ++positions_version_;
  }
  /// Raised whenever particles have moved or changed places in storage.
  [[nodiscard]] std::uint64_t positions_version() const { return positions_version_; }
  /// Are neighbours up to date with the positions?
  [[nodiscard]] bool settled() const { return !moved_; }
  /// Brings neighbours up to date with the positions: sorts, if need be, and every field into the new order.
  void settle();
  /// The same for a reader (an observer, a frame), who must leave no trace in the integration. If particles have to be
  /// sorted for it, the order of storage that the integration had is kept, with the positions as they were (sorting
  /// takes particles that left the box back inside, which rounds).
  void settle_for_reader();
  /// Returns to the order of the integration, if a reader had particles sorted. To be called before particles change,
  /// and before a checkpoint.
  void return_to_order();
  /// Stores particles by cell, and those inside that have left the box, for who needs no neighbours: near in space is
  /// near in memory. Leaves neighbours out of date.
  void reorder();
  /// Sorts whether or not it must be.
  void sort_anew();
  /// Sorts as a checkpoint says; see Neighbourhood::restore.
  void restore_order(const std::array<std::vector<double>, 3>& sorted_position);
  /// Brings a field up to date at ghosts and walls, if it is not.
  void refresh_boundary(Field& field);
  /// To be called where a piece of work ends whose time is counted: a device does it later, unless it is waited for.
  void end_of_work() const {
    if (times_each) backend.finish();
  }
  /// What the work of this class took.
  [[nodiscard]] std::vector<Counter> counters() const { return {sorting_, refreshing_}; }

 private:
  void resize_fields();
  void permute_fields(const exec::Array<Index>& order);
  void keep_order();
  /// The order of storage that the integration had before a reader's sorting.
  struct Order {
    Particles particles;
    std::array<std::vector<double>, 3> sorted_position;
    exec::Array<Index> way_back;  // a permutation
  };
  bool moved_ = true;
  std::uint64_t positions_version_ = 1;
  std::optional<Order> kept_order_;
  Field::Scratch scratch_;
  BoundaryValues boundary_values_;
  Counter sorting_{"framework: neighbours, sorting"};
  Counter refreshing_{"framework: values beyond the faces"};
};

}  // namespace mesogen
