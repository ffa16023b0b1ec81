#pragma once

#include <string>

#include "exec/backend.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// What libmesogen_cuda gives: a backend, or why there is none.
struct CudaBackend {
  const Backend* backend = nullptr;
  std::string problem;
};

/// The backend on a CUDA device, from a library of its own beside libmesogen, loaded when first asked for. With the
/// variable MESOGEN_CUDA_ON_HOST = 1 the same code runs on the host: for tests, where there is no device.
[[nodiscard]] MESOGEN_EXPORT CudaBackend cuda_backend();

/// Name of the function that the library exports: CudaBackend* (), once for the life of the process.
inline constexpr const char* cuda_backend_symbol = "mesogen_cuda_backend";
inline constexpr const char* cuda_on_host_variable = "MESOGEN_CUDA_ON_HOST";

}  // namespace mesogen
