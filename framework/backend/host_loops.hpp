#pragma once

#include "backend/backend_impl.hpp"
#include "exec/running_sums.hpp"
#include "neighbours/order_by_cell.hpp"
#include "neighbours/outside.hpp"

namespace mesogen::exec {

/// The loops over cells on the host, or on a device that the host plays.
class HostCellLoops final : public CellLoopsImpl {
 public:
  explicit HostCellLoops(Reductions& reductions) : CellLoopsImpl({}, reductions) {}

  void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const override {
    order_by_cell(cell, id, count, cells, order);
  }
  Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                     Index* found) const override {
    return exec::find_outside(position, box, dimension, count, found);
  }
  Index running_sums(Index* values, Index count) const override { return exec::running_sums(values, count); }
};

}  // namespace mesogen::exec
