#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

#include "exec/memory.hpp"
#include "exec/pair_loops.hpp"
#include "ghosts/views.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/export.hpp"
#include "mesogen/neighbours/neighbours.hpp"
#include "mesogen/particles/field_view.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen {

class CellGrid;
struct ImageSearch;
struct FieldDeclaration;
struct Pass;
struct Transport;

/// The framework's own loops. They are written once, as functors; each backend compiles them for where it runs.
namespace exec {

/// f = from + by * rate, in double, and what passes see of it.
template <class Real>
struct Advancing {
  FieldView<const double> from;
  FieldView<const Real> rate;
  double by;
  FieldView<double> exact;
  FieldView<Real> rounded;
  int components;
};

/// Where a number will be that a loop looks for, once all are collected: Backend::collect().
struct Finding {
  int place = 0;
  [[nodiscard]] Finding next() const { return {place + 1}; }
};

/// r = r + by * u + shift_by * s.
template <class Real>
struct Moving {
  double* position[3];
  FieldView<const double> velocity;
  double by;
  FieldView<const Real> shift;  ///< may be empty
  double shift_by;
  int dimension;
};

/// A step by a velocity that passes make: half of it, kept as `way`, or the whole of it from where it began.
template <class Real>
struct MovingByPasses {
  double* position[3];
  FieldView<double> way;
  FieldView<const Real> velocity;
  FieldView<const Real> shift;  ///< may be empty
  double step_size;
  bool to_midpoint;
  int dimension;
};

/// Coordinates relative to the tiles of the cell grid, of particles, walls and ghosts.
template <class Real>
struct Placing {
  const double* position[3];
  const double* sorted[3];  ///< where particles were sorted
  Real* local[3];
  const Index* cell_begin;
  const Index* cell_end;
  double farthest_square;  ///< by which a particle may have strayed, m2
  WallView walls;
  GhostView ghosts;
};

/// Ghosts while they are made.
struct GhostArrays {
  Index* source;
  std::uint8_t* image;
  Index* cell;  ///< padded index
  std::array<double*, 3> offset;
};

template <class Real>
class Loops : public PairLoops<Real> {
 public:
  virtual void zero(FieldView<Real> field, int components, Index count) const = 0;
  /// Values of ghosts: those of their sources, by the rules of their images.
  virtual void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<Real> field, int components) const = 0;
  /// Finds the largest squared length of the value, and next of the rate; infinite where something is not a number.
  virtual Finding advance(const Advancing<Real>& advancing, Index count) const = 0;
  /// Finds a number above 0 if a particle is nowhere.
  virtual Finding move(const Moving<Real>& moving, Index count) const = 0;
  virtual Finding move(const MovingByPasses<Real>& moving, Index count) const = 0;
  /// Finds the largest squared length of a vector; infinite where something is not a number.
  virtual Finding largest_square(FieldView<const Real> field, int components, Index count) const = 0;
  /// The same of (u - 2 / dt way): what a step changed.
  virtual Finding largest_change(FieldView<const Real> velocity, FieldView<const double> way, double step_size,
                                 int components, Index count) const = 0;
  /// Finds a number above 0 if a value (a vector's length) is outside the bounds, or not a number.
  virtual Finding is_outside(FieldView<const Real> field, int components, Index count, double lowest,
                             double highest) const = 0;
  /// False if a particle has strayed too far. Waits for the answer.
  virtual bool place(const CellGrid& grid, const Placing<Real>& placing) const = 0;
};

/// Particles in a cell grid.
class CellLoops {
 public:
  CellLoops() = default;
  CellLoops(const CellLoops&) = delete;
  CellLoops& operator=(const CellLoops&) = delete;
  virtual ~CellLoops() = default;

  /// The cell of each position; where there is no such number, some cell.
  virtual void find_cells(const CellGrid& grid, const double* const* position, Index count, Index* cell) const = 0;
  /// Place n takes what stood at order[n]: by cell, by id within a cell.
  virtual void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const = 0;
  /// First and last particle (one past it) of each cell of the box, from particles stored by cell.
  virtual void find_ranges(const CellGrid& grid, const Index* cell, Index count, Index* begin, Index* end) const = 0;
  /// The same of ghosts, for all cells: `cell` has padded indices, `first` is the place of the first ghost.
  virtual void find_ghost_ranges(const CellGrid& grid, const Index* cell, Index count, Index first, Index* begin,
                                 Index* end) const = 0;
  /// Particles outside the box: as many as it returns, in no order, at `found`, which has room for all.
  virtual Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                             Index* found) const = 0;
  /// values[i] becomes the sum of all before it, values[count] the sum of all, which it returns. Waits for the answer.
  virtual Index running_sums(Index* values, Index count) const = 0;

  /// How many ghosts each particle has.
  virtual void count_ghosts(const ImageSearch& search, Index particles, Index* number) const = 0;
  /// Ghosts in the order of their sources: particle i writes from begin[i] on. `number` counts them.
  virtual void list_ghosts(const ImageSearch& search, const CellGrid& grid, Index particles, const Index* begin,
                           const GhostArrays& to, std::int64_t* number) const = 0;
  /// Place n takes what stood at order[n]; `origin` gets the tiles of the cells.
  virtual void order_ghosts(const CellGrid& grid, const GhostArrays& from, const Index* order, Index count,
                            const GhostArrays& to, const std::array<double*, 3>& origin) const = 0;

  virtual void permute(float* values, const Index* order, Index count, float* scratch) const = 0;
  virtual void permute(double* values, const Index* order, Index count, double* scratch) const = 0;
  virtual void permute(std::int32_t* values, const Index* order, Index count, std::int32_t* scratch) const = 0;
  virtual void permute(std::int64_t* values, const Index* order, Index count, std::int64_t* scratch) const = 0;
  virtual void copy(const double* from, double* to, Index count) const = 0;
};

}  // namespace exec

/// Where a run computes: the host, or a CUDA device. Work on a device is only asked for; finish() before the host
/// looks.
/// One for the process: runs that share it take turns.
class MESOGEN_EXPORT Backend {
 public:
  Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
  virtual ~Backend();

  /// "NVIDIA H200"; empty on the host.
  [[nodiscard]] virtual std::string device() const = 0;
  [[nodiscard]] bool on_host() const { return device().empty(); }
  [[nodiscard]] virtual exec::Space space() const = 0;
  [[nodiscard]] virtual exec::Memory& memory() const = 0;
  /// Waits until all that was asked for is done. Throws Error(run_failed) if some of it failed.
  virtual void finish() const = 0;
  /// The same; what loops looked for can be asked then.
  virtual void collect() const = 0;
  [[nodiscard]] virtual double found(exec::Finding finding) const = 0;

  template <class Real>
  [[nodiscard]] const exec::Loops<Real>& loops() const {
    if constexpr (std::is_same_v<Real, float>) {
      return single_loops();
    } else {
      return double_loops();
    }
  }
  [[nodiscard]] virtual const exec::CellLoops& cells() const = 0;
  /// See advection.hpp.
  [[nodiscard]] virtual Pass advection(const FieldDeclaration& field, const Transport& transport) const = 0;

  static const Backend& host();

 protected:
  [[nodiscard]] virtual const exec::Loops<float>& single_loops() const = 0;
  [[nodiscard]] virtual const exec::Loops<double>& double_loops() const = 0;
};

}  // namespace mesogen
