#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "exec/backend.hpp"
#include "ghosts/ghosts.hpp"
#include "ghosts/halo.hpp"
#include "ghosts/mirrors.hpp"
#include "ghosts/parts.hpp"
#include "ghosts/wall_set.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/neighbours.hpp"
#include "neighbours/cell_grid.hpp"
#include "neighbours/cell_loops.hpp"
#include "neighbours/neighbour_blocks.hpp"
#include "particles/particles.hpp"

namespace mesogen {

/// The cell grid and all that lies in it: particles of the fluid, of walls, and ghosts, in this order of storage.
///
/// Cells reach a little farther than the support (the skin), so the sorting and the ghosts stay valid until some
/// particle has moved by half of it: hundreds of steps in a slow flow. All that follows from `sorted_position()`, the
/// coordinates at the last sorting; a checkpoint keeps them, so that a resumed run sums in the same order.
///
/// Where ranks share a run, each has the cell grid of the whole box, its own particles, and as ghosts those of others
/// that it sees.
class MESOGEN_EXPORT Neighbourhood {
 public:
  Neighbourhood(const Scene& scene, const Boundary& boundary, const Backend& backend = Backend::host(),
                const Ranks& ranks = Ranks::alone());

  static constexpr double skin_in_spacings = 0.1;

  /// Particles moved, none of them farther than `farthest` (m) from where it was sorted. False, and neighbours out of
  /// date, if they must be sorted anew: then they must be so on all ranks.
  bool update(const Particles& particles, double farthest);
  /// Where each particle belongs, once those that left the box are back inside: the number of its rank. With
  /// `may_balance` the borders between ranks move, if some have too many.
  std::vector<int> owners(Particles& particles, bool may_balance);
  /// After an update() that was false: sorts particles, which must be this rank's, and finds their neighbours. Returns
  /// the new order of storage: place n takes what stood at order[n]; the particles themselves are already permuted.
  const exec::Array<Index>& sort(Particles& particles);

  /// Moves particles, by arguments of exec::FieldLoops::move, and brings neighbours up to date with that. False, with
  /// nothing done, where particles have to be looked at first, or where there is code of the host: that moves them
  /// faster by itself.
  template <class Real, template <class> class Arguments>
  bool move(const Arguments<Real>& arguments, double farthest);

  /// The same, but finds no neighbours: the next update() does.
  const exec::Array<Index>& reorder(Particles& particles);

  /// Does code of the host sum over pairs too, beside a backend without such code? It goes by blocks, which cost a
  /// search at each sorting.
  void find_blocks_for_host(bool wanted) { blocks_wanted_ = wanted || backend_.has_host_code(); }

  /// Is there an order of storage?
  [[nodiscard]] bool sorted() const { return sorted_; }
  /// The next update() sorts, wherever particles are.
  void forget_order() { sorted_ = false; }

  /// Returns to an earlier sorting: particles are in its order of storage and were sorted at these coordinates. Finds
  /// no neighbours: the next update() does.
  void restore(const Particles& particles, const std::array<std::vector<double>, 3>& sorted_position);
  [[nodiscard]] const exec::AxisArrays<double>& sorted_position() const { return sorted_position_; }

  [[nodiscard]] const WallSet& walls() const { return *walls_; }
  [[nodiscard]] const Ghosts& ghosts() const { return ghosts_; }
  [[nodiscard]] WallView wall_view(exec::Side side) const { return walls_->view(side); }
  [[nodiscard]] GhostView ghost_view(exec::Side side) const;
  /// How much is stored behind the particles: walls, ghosts, and what other ranks send.
  [[nodiscard]] Index boundary_count() const { return walls_->count() + ghosts_.count() + halo_.count(); }
  [[nodiscard]] const Mirrors& mirrors() const { return *mirrors_; }
  /// Raised whenever there are other wall particles.
  [[nodiscard]] std::uint64_t walls_version() const { return walls_version_; }
  [[nodiscard]] Halo& halo() { return halo_; }
  [[nodiscard]] const Halo& halo() const { return halo_; }
  [[nodiscard]] const Parts& parts() const { return parts_; }
  /// The borders between ranks that a checkpoint has.
  void take_parts(std::span<const std::int64_t> begins);
  [[nodiscard]] const CellGrid& grid() const { return grid_; }
  /// How much farther than the support cells reach, m: between sortings a particle strays by at most half of it.
  [[nodiscard]] double skin() const { return skin_; }
  /// How far around a particle neighbours are kept, m: two particles may each stray by half the skin. A hundredth of
  /// the skin is for rounding.
  [[nodiscard]] double neighbour_range() const { return scene_.support + 1.01 * skin_; }
  /// Raised whenever a particle has moved: what was computed from positions is out of date.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  [[nodiscard]] std::int64_t sortings() const { return sortings_; }

  /// For pair sums on this side: code of the host goes by blocks, which lie there; other code goes by runs.
  template <class Real, int Dim>
  void fill(Neighbours<Real, Dim>& grid, exec::Side side) const;

 private:
  [[nodiscard]] Index own() const { return static_cast<Index>(cell_of_.size()); }
  void make_walls();
  void order(Particles& particles);
  void keep_inside(Particles& particles);
  void sort_particles(Particles& particles);
  void find_cells(const exec::AxisArrays<double>& position);
  void build_ghosts(const Particles& particles);
  void make_room();
  template <class Real>
  [[nodiscard]] exec::AxisArrays<Real>& local() {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return local_single_;
    } else {
      return local_double_;
    }
  }
  template <class Real>
  [[nodiscard]] exec::PlaceArguments<Real> placing(const double* const* position, bool looks);
  [[nodiscard]] bool must_look(double farthest) const;
  [[nodiscard]] bool place(const exec::AxisArrays<double>& position, double farthest);
  void find_neighbours();
  template <class Real, int Dim>
  [[nodiscard]] Neighbours<Real, Dim> seen_from(exec::Side side) const {
    Neighbours<Real, Dim> grid{};
    fill(grid, side);
    return grid;
  }
  template <class Real, int Dim>
  void find_runs();

  const Scene& scene_;
  const Boundary& boundary_;
  const Backend& backend_;
  const Ranks& ranks_;
  double skin_;
  CellGrid grid_;
  Parts parts_;

  exec::AxisArrays<double> sorted_position_;
  exec::Array<Index> order_;
  exec::Array<Index> cell_of_;     // number, inside the box, of each particle's cell
  exec::Array<Index> cell_begin_;  // by padded cell
  exec::Array<Index> cell_end_;
  NeighbourBlocks blocks_;
  bool blocks_wanted_;
  exec::Array<Index> run_begin_;  // by particle, one more at the end
  exec::Array<NeighbourRun> run_;
  bool sorted_ = false;  // on all ranks, also on one that has no particles
  bool neighbours_found_ = false;
  Ghosts ghosts_;
  Halo halo_;
  std::optional<WallSet> walls_;
  std::optional<Mirrors> mirrors_;
  std::uint64_t walls_version_ = 0;
  int rows_seen_ = 0;  // beyond those of this rank
  exec::AxisArrays<float> local_single_;
  exec::AxisArrays<double> local_double_;
  /// Room for one array of each kind while particles change places.
  struct Scratch {
    explicit Scratch(exec::DeviceMemory* memory) : position(memory), images(memory), id(memory) {}
    exec::Array<double> position;
    exec::Array<std::int32_t> images;
    exec::Array<std::int64_t> id;
  };
  Scratch scratch_;
  std::uint64_t version_ = 0;
  std::int64_t sortings_ = 0;
};

}  // namespace mesogen
