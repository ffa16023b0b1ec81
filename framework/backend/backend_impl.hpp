#pragma once

#include "exec/backend.hpp"
#include "exec/reductions.hpp"
#include "ghosts/ghost_loops_impl.hpp"
#include "neighbours/cell_loops_impl.hpp"
#include "particles/field_loops_impl.hpp"
#include "particles/storage_loops_impl.hpp"
#include "sph/mirror_loops_impl.hpp"
#include "sph/pair_loops_impl.hpp"

/// All loops of a backend, compiled twice: by g++ for the host, by nvcc for CUDA.
namespace mesogen::exec {

/// All of a backend but where its memory is, how it waits, and how it puts particles in order.
class BackendImpl : public Backend {
 public:
  /// `device`, `pinned`: see Reductions.
  explicit BackendImpl(const Space& space, double* device = nullptr, double* pinned = nullptr)
      : space_(space),
        reductions_(device, pinned),
        storage_(space),
        ghosts_(space),
        single_fields_(space, reductions_),
        double_fields_(space, reductions_),
        single_pairs_(space),
        double_pairs_(space),
        single_mirrors_(space),
        double_mirrors_(space) {}

  [[nodiscard]] Space space() const override { return space_; }
  void wait() const override { reductions_.wait(space_); }
  [[nodiscard]] double found(Reduction reduction) const override { return reductions_.found(reduction); }
  [[nodiscard]] std::span<double> all_found() const override { return reductions_.all(); }
  [[nodiscard]] const StorageLoops& storage() const override { return storage_; }
  [[nodiscard]] const GhostLoops& ghosts() const override { return ghosts_; }

 protected:
  [[nodiscard]] Reductions& reductions() const { return reductions_; }
  [[nodiscard]] const FieldLoops<float>& single_fields() const override { return single_fields_; }
  [[nodiscard]] const FieldLoops<double>& double_fields() const override { return double_fields_; }
  [[nodiscard]] const PairLoops<float>& single_pairs() const override { return single_pairs_; }
  [[nodiscard]] const PairLoops<double>& double_pairs() const override { return double_pairs_; }
  [[nodiscard]] const MirrorLoops<float>& single_mirrors() const override { return single_mirrors_; }
  [[nodiscard]] const MirrorLoops<double>& double_mirrors() const override { return double_mirrors_; }

 private:
  Space space_;
  mutable Reductions reductions_;
  StorageLoopsImpl storage_;
  GhostLoopsImpl ghosts_;
  FieldLoopsImpl<float> single_fields_;
  FieldLoopsImpl<double> double_fields_;
  PairLoopsImpl<float> single_pairs_;
  PairLoopsImpl<double> double_pairs_;
  MirrorLoopsImpl<float> single_mirrors_;
  MirrorLoopsImpl<double> double_mirrors_;
};

}  // namespace mesogen::exec
