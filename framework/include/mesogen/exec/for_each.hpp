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

/// How threads are numbered where `count` of them are started in blocks of `Size`: none is left out, and no number is
/// too large for an int, up to the largest count that an Index can hold.
template <unsigned Size>
struct ThreadBlocks {
  static constexpr unsigned size = Size;

  [[nodiscard]] static constexpr unsigned number(Index count) {
    return (static_cast<unsigned>(count) + Size - 1) / Size;
  }
  /// Of a thread, which may be beyond the last that is wanted: it then is not below `count`.
  [[nodiscard]] static constexpr MESOGEN_HOST_DEVICE unsigned thread(unsigned block, unsigned in_block) {
    return block * Size + in_block;
  }
};

#ifdef __CUDACC__
using LoopBlocks = ThreadBlocks<128>;

template <class Function>
__global__ void __launch_bounds__(LoopBlocks::size) run_for_each(Index count, Function function) {
  const unsigned i = LoopBlocks::thread(blockIdx.x, threadIdx.x);
  if (i < static_cast<unsigned>(count)) function(static_cast<Index>(i));
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
    run_for_each<<<LoopBlocks::number(count), LoopBlocks::size, 0, static_cast<cudaStream_t>(space.stream)>>>(count,
                                                                                                              function);
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
