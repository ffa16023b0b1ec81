#include "exec/backend.hpp"
#include "exec/loops_here.hpp"
#include "exec/order_by_cell.hpp"
#include "exec/outside.hpp"
#include "schedule/advection.hpp"

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
};

class HostBackend final : public Backend {
 public:
  [[nodiscard]] std::string device() const override { return {}; }
  [[nodiscard]] exec::Space space() const override { return {}; }
  [[nodiscard]] exec::Memory& memory() const override { return exec::Memory::host(); }
  void finish() const override {}
  void collect() const override { findings_.collect({}); }
  [[nodiscard]] double found(exec::Finding finding) const override { return findings_.found(finding); }
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }
  [[nodiscard]] Pass advection(const FieldDeclaration& field, const Transport& transport) const override {
    return advection_pass(field, transport);
  }

 protected:
  [[nodiscard]] const exec::Loops<float>& single_loops() const override { return single_; }
  [[nodiscard]] const exec::Loops<double>& double_loops() const override { return double_; }

 private:
  mutable exec::Findings findings_;
  exec::LoopsHere<float> single_{{}, findings_};
  exec::LoopsHere<double> double_{{}, findings_};
  HostCellLoops cells_;
};

}  // namespace

Backend::~Backend() = default;

const Backend& Backend::host() {
  static const HostBackend backend;
  return backend;
}

}  // namespace mesogen
