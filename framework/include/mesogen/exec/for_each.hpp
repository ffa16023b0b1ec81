#pragma once

#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/cuda_check.hpp"
#include "mesogen/exec/first_failure.hpp"
#include "mesogen/exec/subnormals.hpp"
#include "mesogen/exec/work_stealing.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

/// Where the passes of a run are executed.
namespace mesogen::exec {

/// The host (OpenMP) or a CUDA stream. Only device pointers and a stream pass between libraries; each library launches
/// its own device code.
struct Space {
  void* stream = nullptr;  ///< cudaStream_t if `device`, else null
  bool device = false;
};

#ifdef __CUDACC__
template <class Function>
__global__ void run_for_each(Index count, Function function) {
  const Index i = static_cast<Index>(blockIdx.x) * static_cast<Index>(blockDim.x) + static_cast<Index>(threadIdx.x);
  if (i < count) function(i);
}
#endif

/// Calls function(i) for every i in [0, count), in any order and in parallel. `function` must be trivially copyable and
/// write only data of particle i, so that the result does not depend on the order. On the host `function` may throw:
/// the first exception is thrown again here, and some i may then be left out. `what` names the loop in the error if it
/// cannot start on a device.
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
  WorkStealing stealing(blocks.number());
#pragma omp parallel
  {
    [[maybe_unused]] const FlushSubnormals flush;
    const Function copy = function;  // what the loop writes cannot change it, so a compiler may keep it in registers
    stealing.take([&](Index block) {
      try {
        MESOGEN_TURNS_ARE_INDEPENDENT
        for (Index i = blocks.begin(block), end = blocks.end(block); i < end; ++i) copy(i);
      } catch (...) {
        failure.keep();
      }
    });
  }
  failure.rethrow();
}

}  // namespace mesogen::exec
