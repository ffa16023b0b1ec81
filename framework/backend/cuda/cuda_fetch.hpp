#pragma once

#include <cuda_runtime.h>

#include "exec/fetch.hpp"

namespace mesogen {

/// Copies by a stream of its own, into memory that the system keeps in place: only such copies go on beside kernels.
class CudaFetch final : public exec::Fetch {
 public:
  /// `stream`: in which the device is asked for its work.
  explicit CudaFetch(cudaStream_t stream);
  ~CudaFetch() override;

  void begin(const void* device, std::size_t bytes) override;
  [[nodiscard]] const void* wait() override;

 private:
  void make_room(std::size_t bytes);

  int device_ = 0;
  cudaStream_t stream_;
  cudaStream_t own_stream_ = nullptr;
  cudaEvent_t asked_ = nullptr;    // all that the device was asked for before begin() is done
  cudaEvent_t arrived_ = nullptr;  // the bytes are on the host
  void* host_ = nullptr;
  std::size_t room_ = 0;
};

}  // namespace mesogen
