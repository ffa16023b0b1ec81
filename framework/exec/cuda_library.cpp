#include "exec/cuda_library.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace mesogen {

CudaBackend cuda_backend() {
  Dl_info info{};
  // Any symbol of this library tells where it lies.
  if (dladdr(reinterpret_cast<const void*>(&cuda_backend), &info) == 0 || info.dli_fname == nullptr)
    return {nullptr, "libmesogen cannot tell where it lies"};
  const auto file = std::filesystem::absolute(info.dli_fname).parent_path() / "libmesogen_cuda.so";
  if (!std::filesystem::exists(file))
    return {nullptr, "this Mesogen was built without CUDA: build it where nvcc (12 or later) is found"};
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const reason = dlerror();
    return {nullptr, std::string("the dynamic linker refuses its code for CUDA: ") + (reason ? reason : "no reason")};
  }
  using Give = const CudaBackend* (*)();
  const auto give = reinterpret_cast<Give>(dlsym(library, cuda_backend_symbol));
  if (give == nullptr) return {nullptr, file.string() + " exports no " + cuda_backend_symbol};
  return *give();
}

}  // namespace mesogen
