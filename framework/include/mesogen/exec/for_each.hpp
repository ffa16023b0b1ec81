#pragma once

#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/cuda_check.hpp"
#include "mesogen/exec/first_failure.hpp"
#include "mesogen/exec/subnormals.hpp"
#include "mesogen/exec/work_stealing.hpp"
#include "mesogen/export.hpp"
#include "mesogen/particles/field_view.hpp"

/// Where the passes of a run are executed.
namespace mesogen::exec {

/// Host (OpenMP) or a CUDA stream. Only device pointers and a stream cross between libraries; each library launches
/// its own device code.
struct Space {
  void* stream = nullptr;  ///< cudaStream_t, when on a device
  bool device = false;
};

#ifdef __CUDACC__
template <class Function>
__global__ void run_for_each(Index count, Function function) {
  const Index i = static_cast<Index>(blockIdx.x) * static_cast<Index>(blockDim.x) + static_cast<Index>(threadIdx.x);
  if (i < count) function(i);
}
#endif

/// function(i) for every i in [0, count), in any order. `function` is trivially copyable and writes only what belongs
/// to i, so the result does not depend on the order. On the host it may throw; what the first one threw comes out, and
/// some are left out then. `what`: of the loop, for the error if it cannot start on a device.
template <class Function>
void for_each(const Space& space, Index count, const Function& function,
              [[maybe_unused]] const char* what = "a loop over particles") {
#ifdef __CUDACC__
  if (space.device) {
    if (count == 0) return;
    constexpr int block = 128;
    run_for_each<<<(count + block - 1) / block, block, 0, static_cast<cudaStream_t>(space.stream)>>>(count, function);
    check_launch(what);
    return;
  }
#else
  (void)space;
#endif
  FirstFailure failure;
  const Blocks blocks(count);
  WorkStealing turns(blocks.number());
#pragma omp parallel
  {
    [[maybe_unused]] const FlushSubnormals flush;
    turns.take([&](Index block) {
      try {
        for (Index i = blocks.begin(block); i < blocks.end(block); ++i) function(i);
      } catch (...) {
        failure.keep();
      }
    });
  }
  failure.rethrow();
}

}  // namespace mesogen::exec
