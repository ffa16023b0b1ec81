#include "run/choose_backend.hpp"

#include "backend/cuda_library.hpp"
#include "ranks/mpi_library.hpp"

namespace mesogen {

namespace {

/// Why not all physics of a case can compute on a device; empty if they can. What is no plugin at all is told
/// elsewhere.
std::string without_code(const Case& source, const PluginRegistry& registry) {
  for (const PluginChoice& choice : source.physics) {
    if (registry.find(PluginKind::physics, choice.type) == nullptr) continue;
    if (!registry.has_cuda(choice.type)) return "'" + choice.type + "' has no code for CUDA";
    if (std::string problem = registry.cuda_problem(choice.type); !problem.empty()) return problem;
  }
  return {};
}

}  // namespace

BackendChoice choose_backend(const Case& source, const PluginRegistry& registry) {
  BackendChoice choice;
  const bool everywhere = cuda_on_host() == CudaOnHost::everywhere;
  if (source.run.device == "cpu" && !everywhere) return choice;
  const bool automatic = source.run.device != "cuda";
  if (processes_started() > 1) {
    (automatic ? choice.why_on_host : choice.problem) =
        "several ranks compute on the host alone, \"cpu\"; on a device take one process";
    return choice;
  }
  if (automatic) choice.why_on_host = without_code(source, registry);
  if (!choice.why_on_host.empty()) return choice;
  const CudaBackend cuda = cuda_backend();
  if (cuda.backend != nullptr) {
    choice.backend = cuda.backend;
  } else if (automatic) {
    choice.why_on_host = cuda.problem;
  } else {
    choice.problem = cuda.problem + R"(; take "cpu", or "auto" for CUDA where that can be)";
  }
  return choice;
}

}  // namespace mesogen
