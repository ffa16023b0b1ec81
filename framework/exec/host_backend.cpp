#include "exec/backend.hpp"
#include "exec/loops_here.hpp"
#include "exec/order_by_cell.hpp"
#include "exec/outside.hpp"
#include "exec/running_sums.hpp"

namespace mesogen {

namespace {

class HostCellLoops final : public exec::CellLoopsHere {
 public:
  HostCellLoops() : CellLoopsHere(exec::Space{}) {}
  void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const override {
    exec::order_by_cell(cell, id, count, cells, order);
  }
  Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                     Index* found) const override {
    return exec::find_outside(position, box, dimension, count, found);
  }
  Index running_sums(Index* values, Index count) const override { return exec::running_sums(values, count); }
};

class HostBackend final : public exec::BackendHere {
 public:
  HostBackend() : BackendHere(exec::Space{}) {}
  [[nodiscard]] std::string device() const override { return {}; }
  [[nodiscard]] exec::Memory& memory() const override { return exec::Memory::host(); }
  void finish() const override {}
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }

 private:
  HostCellLoops cells_;
};

}  // namespace

Backend::~Backend() = default;

const Backend& Backend::host() {
  static const HostBackend backend;
  return backend;
}

}  // namespace mesogen
