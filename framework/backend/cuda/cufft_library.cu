#include "backend/cuda/cufft_library.hpp"

#include <dlfcn.h>

#include <string>

#include "mesogen/diagnostics/build_tag.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

constexpr const char* file = "libcufft.so." MESOGEN_STRINGIFY(CUFFT_VER_MAJOR);

[[noreturn]] void refuse() {
  const char* const reason = dlerror();
  throw Error(ExitCode::run_failed,
              std::string("a flow on a mesh needs cuFFT on a CUDA device: install it, as a part of "
                          "the CUDA toolkit, or take run.device = \"cpu\" (") +
                  (reason != nullptr ? reason : file) + ")");
}

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) refuse();
}

CufftLibrary load() {
  // Looked for where libmesogen_cuda looks for its libraries.
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) refuse();
  CufftLibrary all{};
  find(library, "cufftCreate", all.create);
  find(library, "cufftDestroy", all.destroy);
  find(library, "cufftSetAutoAllocation", all.set_auto_allocation);
  find(library, "cufftMakePlanMany", all.make_plan_many);
  find(library, "cufftSetStream", all.set_stream);
  find(library, "cufftSetWorkArea", all.set_work_area);
  find(library, "cufftExecR2C", all.forward_single);
  find(library, "cufftExecC2R", all.backward_single);
  find(library, "cufftExecD2Z", all.forward_double);
  find(library, "cufftExecZ2D", all.backward_double);
  return all;
}

}  // namespace

const CufftLibrary& cufft() {
  static const CufftLibrary library = load();
  return library;
}

}  // namespace mesogen
