#include "backend/cuda_library.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace mesogen {

CudaBackend cuda_backend() {
  Dl_info info{};
  // Any symbol of this library tells where it lies.
  if (dladdr(reinterpret_cast<const void*>(&cuda_backend), &info) == 0 || info.dli_fname == nullptr)
    return {nullptr, "libmesogen cannot find the folder that it is in"};
  const auto file = std::filesystem::absolute(info.dli_fname).parent_path() / "libmesogen_cuda.so";
  if (!std::filesystem::exists(file))
    return {nullptr,
            "this Mesogen was built without CUDA: build it by `MESOGEN_CUDA=on scripts/setup`, which needs nvcc (12 or "
            "later)"};
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const reason = dlerror();
    return {nullptr, std::string("the dynamic linker refuses its code for CUDA: ") + (reason ? reason : "no reason")};
  }
  const auto* const found = static_cast<const CudaLibrary*>(dlsym(library, cuda_library_symbol));
  if (found == nullptr) return {nullptr, file.string() + " exports no `" + cuda_library_symbol + "`"};
  if (const std::string problem = cuda_library_problem(*found); !problem.empty())
    return {nullptr, file.string() + ": " + problem};
  return *found->backend();
}

CudaOnHost cuda_on_host() {
  const char* const value = std::getenv("MESOGEN_CUDA_ON_HOST");
  const std::string_view wanted = value == nullptr ? "" : value;
  return wanted == "1" ? CudaOnHost::where_asked : wanted == "everywhere" ? CudaOnHost::everywhere : CudaOnHost::no;
}

std::string cuda_library_problem(const CudaLibrary& library) {
  if (library.magic != cuda_library_magic) return "what it exports is not Mesogen's code for CUDA";
  if (library.build == nullptr || library.build != std::string_view(MESOGEN_CUDA_BUILD))
    return std::string("it belongs to another Mesogen (") + (library.build == nullptr ? "unknown" : library.build) +
           ") than this one (" MESOGEN_CUDA_BUILD "): build and install both together";
  return {};
}

}  // namespace mesogen
