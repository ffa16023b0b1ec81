#pragma once

#ifdef __CUDACC__

#include <cuda_runtime.h>

#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen::exec {

/// Throws Error(run_failed) if a call of the CUDA runtime failed. It may report what an earlier kernel did wrong.
inline void check_cuda(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  throw Error(ExitCode::run_failed,
              std::string("the CUDA device failed (at or before ") + what + "): " + cudaGetErrorString(status));
}

/// After the start of a kernel: did it start?
inline void check_launch(const char* what) {
  if (cudaPeekAtLastError() == cudaSuccess) return;
  check_cuda(cudaGetLastError(), what);  // so that nobody else reports it
}

}  // namespace mesogen::exec

#endif
