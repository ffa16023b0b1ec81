#pragma once

#include <cufft.h>

namespace mesogen {

/// cuFFT, loaded when a mesh is first transformed on a device: it takes 280 MB of disk, and other runs do without.
struct CufftLibrary {
  decltype(&cufftCreate) create;
  decltype(&cufftDestroy) destroy;
  decltype(&cufftSetAutoAllocation) set_auto_allocation;
  decltype(&cufftMakePlanMany) make_plan_many;
  decltype(&cufftSetStream) set_stream;
  decltype(&cufftSetWorkArea) set_work_area;
  decltype(&cufftExecR2C) forward_single;
  decltype(&cufftExecC2R) backward_single;
  decltype(&cufftExecD2Z) forward_double;
  decltype(&cufftExecZ2D) backward_double;
};

/// Throws Error(run_failed) where there is no cuFFT.
[[nodiscard]] const CufftLibrary& cufft();

}  // namespace mesogen
