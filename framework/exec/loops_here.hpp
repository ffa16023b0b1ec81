#pragma once

#include <stdexcept>

#include "exec/cell_functors.hpp"
#include "exec/largest.hpp"
#include "exec/motion_functors.hpp"
#include "exec/pair_loops_here.hpp"
#include "ghosts/ghost_functors.hpp"
#include "schedule/advection.hpp"

/// The framework's loops as the compiler of this file makes them: included once by the host's backend, once by that of
/// a device.
namespace mesogen::exec {

template <class Real>
class LoopsHere final : public PairLoopsHere<Real, Loops<Real>, BuiltDimensions> {
 public:
  LoopsHere(const Space& space, Findings& findings)
      : PairLoopsHere<Real, Loops<Real>, BuiltDimensions>(space), findings_(findings) {}

  void zero(FieldView<Real> field, int components, Index count) const override {
    for_each(space_, count, Zero<Real>{field, components});
  }
  void refresh(const GhostView& ghosts, const RuleView& rules, FieldView<Real> field, int components) const override {
    for_each(space_, ghosts.count, RefreshGhosts<Real>{field, components, ghosts, rules});
  }
  Finding advance(const Advancing<Real>& advancing, Index count) const override {
    switch (advancing.components) {
      case 1: return advance_of<1>(advancing, count);
      case 2: return advance_of<2>(advancing, count);
      case 3: return advance_of<3>(advancing, count);
      case 4: return advance_of<4>(advancing, count);
      case 5: return advance_of<5>(advancing, count);
      case 9: return advance_of<9>(advancing, count);
      default: throw std::logic_error("a number of components that no rank has");
    }
  }
  Finding move(const Moving<Real>& moving, Index count) const override {
    return find_largest<1>(space_, findings_, count, Move<Real>{moving});
  }
  Finding move(const MovingByPasses<Real>& moving, Index count) const override {
    return find_largest<1>(space_, findings_, count, MoveByPasses<Real>{moving});
  }
  Finding largest_square(FieldView<const Real> field, int components, Index count) const override {
    return find_largest<1>(space_, findings_, count, SquaredLength<Real>{field, components});
  }
  Finding largest_change(FieldView<const Real> velocity, FieldView<const double> way, double step_size, int components,
                         Index count) const override {
    return find_largest<1>(space_, findings_, count, SquaredChange<Real>{velocity, way, 2.0 / step_size, components});
  }
  Finding is_outside(FieldView<const Real> field, int components, Index count, double lowest,
                     double highest) const override {
    if (components == 1)
      return find_largest<1>(space_, findings_, count, ValueOutside<Real>{field, Real(lowest), Real(highest)});
    return find_largest<1>(space_, findings_, count,
                           LengthOutside<Real>{field, components, Real(lowest), Real(highest)});
  }
  bool place(const CellGrid& grid, const Placing<Real>& placing) const override {
    const Finding strayed =
        find_largest<1>(space_, findings_, grid.inside_count(), PlaceParticles<Real>{grid, placing});
    findings_.collect(space_);
    if (findings_.found(strayed) > 0.0) return false;
    for_each(space_, placing.walls.count, PlaceWalls<Real>{grid.dimension(), placing});
    for_each(space_, placing.ghosts.count, PlaceGhosts<Real>{grid.dimension(), placing});
    return true;
  }

 private:
  template <int Components>
  Finding advance_of(const Advancing<Real>& advancing, Index count) const {
    return find_largest<2>(space_, findings_, count, Advance<Real, Components>{advancing});
  }

  using PairLoopsHere<Real, Loops<Real>, BuiltDimensions>::space_;
  Findings& findings_;
};

/// All that can be written as loops over what is there: not how particles are put in order.
class CellLoopsHere : public CellLoops {
 public:
  explicit CellLoopsHere(const Space& space) : space_(space) {}

  void find_cells(const CellGrid& grid, const double* const* position, Index count, Index* cell) const override {
    for_each(space_, count, FindCell{grid, {position[0], position[1], position[2]}, cell});
  }
  void find_ranges(const CellGrid& grid, const Index* cell, Index count, Index* begin, Index* end) const override {
    for_each(space_, count + 1, FindRanges{grid, cell, count, begin, end});
  }
  void find_ghost_ranges(const CellGrid& grid, const Index* cell, Index count, Index first, Index* begin,
                         Index* end) const override {
    for_each(space_, count + 1, FindGhostRanges{cell, count, first, grid.padded_count(), begin, end});
  }
  void count_ghosts(const ImageSearch& search, Index particles, Index* number) const override {
    for_each(space_, particles, CountGhosts{search, number});
  }
  void list_ghosts(const ImageSearch& search, const CellGrid& grid, Index particles, const Index* begin,
                   const GhostArrays& to, std::int64_t* number) const override {
    for_each(space_, particles, ListGhosts{search, grid, begin, to, number});
  }
  void order_ghosts(const CellGrid& grid, const GhostArrays& from, const Index* order, Index count,
                    const GhostArrays& to, const std::array<double*, 3>& origin) const override {
    for_each(space_, count, OrderGhosts{grid, from, order, to, origin});
  }
  void permute(float* values, const Index* order, Index count, float* scratch) const override {
    permuted(values, order, count, scratch);
  }
  void permute(double* values, const Index* order, Index count, double* scratch) const override {
    permuted(values, order, count, scratch);
  }
  void permute(std::int32_t* values, const Index* order, Index count, std::int32_t* scratch) const override {
    permuted(values, order, count, scratch);
  }
  void permute(std::int64_t* values, const Index* order, Index count, std::int64_t* scratch) const override {
    permuted(values, order, count, scratch);
  }
  void copy(const double* from, double* to, Index count) const override {
    for_each(space_, count, Copy<double>{from, to});
  }

 protected:
  [[nodiscard]] const Space& space() const { return space_; }

 private:
  template <class T>
  void permuted(T* values, const Index* order, Index count, T* scratch) const {
    for_each(space_, count, Gather<T>{values, order, scratch});
    for_each(space_, count, Copy<T>{scratch, values});
  }

  Space space_;
};

/// All of a backend but where its memory is, how it waits, and how it puts particles in order.
class BackendHere : public Backend {
 public:
  /// `there`, `here`: see Findings.
  explicit BackendHere(const Space& space, double* there = nullptr, double* here = nullptr)
      : space_(space), findings_(there, here), single_(space, findings_), double_(space, findings_) {}

  [[nodiscard]] Space space() const override { return space_; }
  void collect() const override {
    findings_.collect(space_);
    finish();
  }
  [[nodiscard]] double found(Finding finding) const override { return findings_.found(finding); }
  [[nodiscard]] Pass advection(const FieldDeclaration& field, const Transport& transport) const override {
    return advection_pass(field, transport);
  }

 protected:
  [[nodiscard]] const Loops<float>& single_loops() const override { return single_; }
  [[nodiscard]] const Loops<double>& double_loops() const override { return double_; }

 private:
  Space space_;
  mutable Findings findings_;
  LoopsHere<float> single_;
  LoopsHere<double> double_;
};

}  // namespace mesogen::exec
