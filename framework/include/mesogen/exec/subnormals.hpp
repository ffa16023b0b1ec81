#pragma once

#if defined(__SSE__) && !defined(__CUDACC__)
#include <xmmintrin.h>
#endif

namespace mesogen::exec {

/// While an object of this class lives, this thread treats numbers too small for full precision (below 1.2e-38 in
/// single precision) as zero. A processor needs a hundred times as long for such a number, and particles on a lattice
/// make many: the fourth-order moment of two particles side by side is one. `for_each` and the search for the largest
/// value use this class on all threads. Where the processor has no such switch, the class does nothing.
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
