#pragma once

#include <cstdint>
#include <string>

#include "exec/backend.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/descriptor.hpp"

namespace mesogen {

/// What libmesogen_cuda gives: a backend, or why there is none.
struct CudaBackend {
  const Backend* backend = nullptr;
  std::string problem;
};

/// The backend on a CUDA device, from a library of its own beside libmesogen, loaded when first asked for. With the
/// variable MESOGEN_CUDA_ON_HOST the same code runs on the host, with memory of its own (exec/emulated_memory.hpp): for
/// tests, where there is no device. MESOGEN_CUDA_ON_HOST_BYTES says how much memory that is.
[[nodiscard]] MESOGEN_EXPORT CudaBackend cuda_backend();

/// What MESOGEN_CUDA_ON_HOST says: not set, "1", or "everywhere".
enum class CudaOnHost {
  no,
  where_asked,  ///< where a run asks for CUDA
  everywhere,   ///< also in runs on the CPU: a whole suite of tests then sees what is out of date on either side
};
[[nodiscard]] MESOGEN_EXPORT CudaOnHost cuda_on_host();

/// The one thing that the library exports, under the name `mesogen_cuda`: plain data, checked before anything behind it
/// is touched. Types inside of Mesogen cross this border, so both sides are to be of one build.
struct CudaLibrary {
  std::uint64_t magic;
  const char* build;                ///< MESOGEN_CUDA_BUILD of the library
  const CudaBackend* (*backend)();  ///< the same answer for the life of the process
};

inline constexpr std::uint64_t cuda_library_magic = 0x4d65736f43554441;  // "MesoCUDA"
inline constexpr const char* cuda_library_symbol = "mesogen_cuda";
inline constexpr const char* cuda_on_host_bytes_variable = "MESOGEN_CUDA_ON_HOST_BYTES";

/// Of which build a side is; each says it for itself.
#define MESOGEN_CUDA_BUILD MESOGEN_VERSION ", interface " MESOGEN_STRINGIFY(MESOGEN_ABI) ", " MESOGEN_BUILD_TAG

/// What is wrong with what a library exports, in words; empty if nothing.
[[nodiscard]] MESOGEN_EXPORT std::string cuda_library_problem(const CudaLibrary& library);

}  // namespace mesogen
