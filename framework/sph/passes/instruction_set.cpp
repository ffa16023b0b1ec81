#include "sph/standard_passes.hpp"

namespace mesogen::sph {

std::string instruction_set() {
#if defined(__AVX512F__)
  return "x86-64-v4";
#elif defined(__AVX2__)
  return "x86-64-v3";
#else
  return "baseline";
#endif
}

}  // namespace mesogen::sph
