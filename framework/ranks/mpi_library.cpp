#include "ranks/mpi_library.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

std::string library_folder() {
  Dl_info info{};
  // Any symbol of this library tells where it lies.
  if (dladdr(reinterpret_cast<const void*>(&ranks_of_process), &info) == 0 || info.dli_fname == nullptr) return {};
  return std::filesystem::absolute(info.dli_fname).parent_path().string();
}

const Ranks& load(int processes) {
  const std::string started = "this process was started as one of " + std::to_string(processes) + ", but ";
  const auto file = std::filesystem::path(library_folder()) / "libmesogen_mpi.so";
  if (!std::filesystem::exists(file))
    throw Error(ExitCode::bad_case,
                started +
                    "this Mesogen was built without MPI: build it by `scripts/setup --mpi`, or start it without "
                    "mpirun or srun");
  // MPI loads parts of itself, which look for its symbols everywhere.
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const reason = dlerror();
    throw Error(ExitCode::bad_case, started + "the dynamic linker refuses " + file.string() + ": " +
                                        (reason == nullptr ? "no reason" : reason));
  }
  const auto* const found = static_cast<const MpiLibrary*>(dlsym(library, mpi_library_symbol));
  const std::string problem =
      found == nullptr ? "it exports no `" + std::string(mpi_library_symbol) + "`" : mpi_library_problem(*found);
  if (!problem.empty()) throw Error(ExitCode::bad_case, started + file.string() + ": " + problem);
  const Ranks& ranks = *found->ranks();
  if (ranks.count() != processes)
    throw Error(ExitCode::bad_case, started + "MPI sees " + std::to_string(ranks.count()) +
                                        ": start it by the mpirun of the MPI that Mesogen was built with, or by srun "
                                        "--mpi=pmix");
  return ranks;
}

}  // namespace

int processes_started() {
  // Open MPI; MPICH and others that use its process manager; a step of Slurm.
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const value = std::getenv(name); value != nullptr && std::atoi(value) > 1) return std::atoi(value);
  return 1;
}

const Ranks& ranks_of_process() {
  static const Ranks& ranks = processes_started() > 1 ? load(processes_started()) : Ranks::alone();
  return ranks;
}

std::string mpi_library_problem(const MpiLibrary& library) {
  if (library.magic != mpi_library_magic) return "what it exports is not Mesogen's code for MPI";
  if (library.build == nullptr || library.build != std::string_view(MESOGEN_MPI_BUILD))
    return std::string("it belongs to another Mesogen (") + (library.build == nullptr ? "unknown" : library.build) +
           ") than this one (" MESOGEN_MPI_BUILD "): build and install both together";
  return {};
}

}  // namespace mesogen
