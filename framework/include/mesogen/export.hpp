#pragma once

/// Marks symbols that other libraries use. All other symbols are hidden.
#define MESOGEN_EXPORT __attribute__((visibility("default")))

/// Marks functions that run on the host and also, compiled by nvcc, on a device: functors of a pass, for example.
#ifdef __CUDACC__
#define MESOGEN_HOST_DEVICE __host__ __device__
#else
#define MESOGEN_HOST_DEVICE
#endif
