#pragma once

#include <cuda_runtime.h>

#include <cmath>
#include <cstdio>

#include "exec/reductions.hpp"

/// What loops on a device look for: no emulation runs this.
namespace mesogen::test {

struct Slopes {
  double height;

  MESOGEN_HOST_DEVICE void operator()(Index i, exec::Maxima<3>& largest) const {
    largest.raise(0, height + i);
    largest.raise(1, height / (1 + i));
    largest.raise(2, i == 7 ? height : 0.0);
  }
};

/// Looks many times, for less each time, and waits now and then: no result may be left of an earlier one, or be read
/// before it came. Returns whether all were right.
inline bool reductions_are_right() {
  constexpr Index count = 100'000;
  constexpr int together = 5;
  double* device = nullptr;
  double* pinned = nullptr;
  cudaStream_t stream = nullptr;
  bool ready = cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking) == cudaSuccess;
  ready = ready && cudaMalloc(&device, exec::Reductions::size * sizeof(double)) == cudaSuccess;
  ready = ready && cudaMallocHost(&pinned, exec::Reductions::size * sizeof(double)) == cudaSuccess;
  ready = ready && cudaMemsetAsync(device, 0, exec::Reductions::size * sizeof(double), stream) == cudaSuccess;
  if (!ready) return false;
  exec::Reductions reductions(device, pinned);
  const exec::Space space{stream, true};
  bool right = true;
  for (int round = 0; round < 60 && right; ++round) {
    exec::Reduction found[together];
    for (int n = 0; n < together; ++n)
      found[n] = exec::find_largest<3>(space, reductions, count, Slopes{1000.0 - 10.0 * round - n}, "looking");
    reductions.wait(space);
    for (int n = 0; n < together; ++n) {
      const double height = 1000.0 - 10.0 * round - n;
      right = right && reductions.found(found[n]) == height + (count - 1) &&
              reductions.found(found[n].next()) == height && reductions.found(found[n].next().next()) == height;
    }
  }
  std::printf("what loops look for on the device: %s\n", right ? "right" : "WRONG");
  cudaFree(device);
  cudaFreeHost(pinned);
  cudaStreamDestroy(stream);
  return right;
}

}  // namespace mesogen::test
