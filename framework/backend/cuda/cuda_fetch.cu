#include "backend/cuda/cuda_fetch.hpp"

#include "mesogen/exec/cuda_check.hpp"

namespace mesogen {

using exec::check_cuda;

namespace {

constexpr const char* preparing = "preparing copies beside its work";
constexpr const char* copying = "a copy to the host beside its work";

}  // namespace

CudaFetch::CudaFetch(cudaStream_t stream) : stream_(stream) {
  check_cuda(cudaGetDevice(&device_), preparing);
  check_cuda(cudaStreamCreateWithFlags(&own_stream_, cudaStreamNonBlocking), preparing);
  check_cuda(cudaEventCreateWithFlags(&asked_, cudaEventDisableTiming), preparing);
  // Who waits sleeps: the processor has other work.
  check_cuda(cudaEventCreateWithFlags(&arrived_, cudaEventDisableTiming | cudaEventBlockingSync), preparing);
}

CudaFetch::~CudaFetch() {
  (void)cudaStreamSynchronize(own_stream_);
  (void)cudaFreeHost(host_);
  (void)cudaEventDestroy(arrived_);
  (void)cudaEventDestroy(asked_);
  (void)cudaStreamDestroy(own_stream_);
}

void CudaFetch::begin(const void* device, std::size_t bytes) {
  make_room(bytes);
  check_cuda(cudaEventRecord(asked_, stream_), copying);
  check_cuda(cudaStreamWaitEvent(own_stream_, asked_, 0), copying);
  check_cuda(cudaMemcpyAsync(host_, device, bytes, cudaMemcpyDeviceToHost, own_stream_), copying);
  check_cuda(cudaEventRecord(arrived_, own_stream_), copying);
}

const void* CudaFetch::wait() {
  // Each thread has a current device of its own.
  check_cuda(cudaSetDevice(device_), copying);
  check_cuda(cudaEventSynchronize(arrived_), copying);
  return host_;
}

void CudaFetch::make_room(std::size_t bytes) {
  if (bytes <= room_) return;
  (void)cudaFreeHost(host_);
  host_ = nullptr;
  room_ = 0;
  const cudaError_t status = cudaMallocHost(&host_, bytes);
  if (status == cudaErrorMemoryAllocation) (void)cudaGetLastError();  // so that nobody else reports it
  check_cuda(status, "taking memory of the host for copies beside its work");
  room_ = bytes;
}

}  // namespace mesogen
