#pragma once

#if defined(__SSE__) && !defined(__CUDACC__)
#include <immintrin.h>
#endif

namespace mesogen::exec {

/// As long as it lives, numbers too small for full precision (below 1.2e-38 in single precision) are zero on this
/// thread. A processor takes a hundred times as long over one, and particles on a lattice make many: a moment of fourth
/// order of two that lie side by side. `for_each` and the search for the largest have it, on all threads. Where there
/// is no such switch it does nothing.
class FlushSubnormals {
#if defined(__SSE__) && !defined(__CUDACC__)
 public:
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | results | operands); }
  ~FlushSubnormals() { _mm_setcsr(before_); }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
  static constexpr unsigned results = 0x8000, operands = 0x0040;  // of the control and status register
  unsigned before_;
#endif
};

}  // namespace mesogen::exec
