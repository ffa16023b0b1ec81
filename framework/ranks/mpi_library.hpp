#pragma once

#include <cstdint>
#include <string>

#include "mesogen/diagnostics/build_tag.hpp"
#include "mesogen/export.hpp"
#include "ranks/ranks.hpp"

namespace mesogen {

/// The ranks of this process: of all that mpirun or srun started it with, or alone. Those of MPI come from a library of
/// their own beside libmesogen, libmesogen_mpi, which is loaded only where there are others. Throws Error(bad_case) if
/// there are, and it cannot be loaded.
[[nodiscard]] MESOGEN_EXPORT const Ranks& ranks_of_process();

/// How many processes whatever started this one says that there are; 1 if nothing says so.
[[nodiscard]] MESOGEN_EXPORT int processes_started();

/// The one thing that the library exports, under the name `mesogen_mpi`: plain data, checked before anything behind it
/// is touched.
struct MpiLibrary {
  std::uint64_t magic;
  const char* build;        ///< MESOGEN_MPI_BUILD of the library
  const Ranks* (*ranks)();  ///< the same for the life of the process
};

inline constexpr std::uint64_t mpi_library_magic = 0x4d65736f4d50492e;  // "MesoMPI."
inline constexpr const char* mpi_library_symbol = "mesogen_mpi";

/// Of which build a side is; each says it for itself.
#define MESOGEN_MPI_BUILD MESOGEN_VERSION ", " MESOGEN_BUILD_TAG

/// What is wrong with what a library exports, in words; empty if nothing.
[[nodiscard]] MESOGEN_EXPORT std::string mpi_library_problem(const MpiLibrary& library);

}  // namespace mesogen
