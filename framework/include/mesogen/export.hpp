#pragma once

/// Symbols that cross a library boundary are marked; everything else is hidden.
#define MESOGEN_EXPORT __attribute__((visibility("default")))

/// Functors of a pass run on the host and, compiled by nvcc, on the device.
#ifdef __CUDACC__
#define MESOGEN_HOST_DEVICE __host__ __device__
#else
#define MESOGEN_HOST_DEVICE
#endif
