// The backend on a CUDA device. Its loops are those of the host, compiled by nvcc; what stands here is memory, order,
// and what can go wrong.

#include <cuda_runtime.h>

#include <cstdlib>
#include <cstring>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <memory>
#include <new>

#include "exec/backend.hpp"
#include "exec/cuda_library.hpp"
#include "exec/loops_here.hpp"
#include "exec/order_by_cell.hpp"
#include "exec/outside.hpp"
#include "exec/running_sums.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

void check(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  throw Error(ExitCode::run_failed,
              std::string("the CUDA device failed (") + what + "): " + cudaGetErrorString(status));
}

/// Memory that host and device share: pages go where they are used.
class SharedMemory final : public exec::Memory {
 public:
  [[nodiscard]] void* allocate(std::size_t bytes) override {
    void* place = nullptr;
    const cudaError_t status = cudaMallocManaged(&place, bytes == 0 ? 1 : bytes);
    if (status == cudaErrorMemoryAllocation) {
      (void)cudaGetLastError();
      throw std::bad_alloc();
    }
    check(status, "taking memory");  // it also tells of what went wrong before
    return place;
  }
  void release(void* place) noexcept override { (void)cudaFree(place); }
};

/// Room on the device that grows as needed.
class Room {
 public:
  Room() = default;
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  ~Room() { (void)cudaFree(place_); }

  void* of(std::size_t bytes) {
    if (bytes > size_) {
      (void)cudaFree(place_);
      place_ = nullptr;
      size_ = 0;
      check(cudaMalloc(&place_, bytes + bytes / 8), "room for sorting");
      size_ = bytes + bytes / 8;
    }
    return place_;
  }

 private:
  void* place_ = nullptr;
  std::size_t size_ = 0;
};

/// Sorted by this: cell first, then id, which a field's Index can count.
struct SortingKey {
  const Index* cell;
  const std::int64_t* id;
  std::uint64_t* key;
  Index* place;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    key[i] = (static_cast<std::uint64_t>(cell[i]) << 32) | static_cast<std::uint64_t>(id[i]);
    place[i] = i;
  }
};

struct Box {
  const double* position[3];
  double length[3];
  int dimension;
};

__global__ void note_outside(Box box, Index count, Index* found, Index* number) {
  const Index i = static_cast<Index>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < count && !exec::is_inside(box.position, box.length, box.dimension, i)) found[atomicAdd(number, 1)] = i;
}

class CudaCellLoops final : public exec::CellLoopsHere {
 public:
  explicit CudaCellLoops(const exec::Space& space) : CellLoopsHere(space) {}

  void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const override {
    if (!space().device) return exec::order_by_cell(cell, id, count, cells, order);
    if (count == 0) return;
    const auto stream = static_cast<cudaStream_t>(space().stream);
    const auto number = static_cast<std::size_t>(count);
    auto* const keys = static_cast<std::uint64_t*>(keys_.of(2 * number * sizeof(std::uint64_t)));
    auto* const places = static_cast<Index*>(places_.of(number * sizeof(Index)));
    exec::for_each(space(), count, SortingKey{cell, id, keys, places});
    int bits = 32;
    while ((static_cast<std::int64_t>(cells) >> (bits - 32)) != 0) ++bits;
    std::size_t bytes = 0;
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, keys + number, places, order, count, 0, bits, stream),
          "sorting");
    check(cub::DeviceRadixSort::SortPairs(scratch_.of(bytes), bytes, keys, keys + number, places, order, count, 0, bits,
                                          stream),
          "sorting");
  }

  Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                     Index* found) const override {
    if (!space().device) return exec::find_outside(position, box, dimension, count, found);
    if (count == 0) return 0;
    const auto stream = static_cast<cudaStream_t>(space().stream);
    auto* const number = static_cast<Index*>(number_.of(sizeof(Index)));
    check(cudaMemsetAsync(number, 0, sizeof(Index), stream), "looking for who left the box");
    constexpr int block = 256;
    const Box all{{position[0], position[1], position[2]}, {box[0], box[1], box[2]}, dimension};
    note_outside<<<(count + block - 1) / block, block, 0, stream>>>(all, count, found, number);
    Index left = 0;
    check(cudaMemcpyAsync(&left, number, sizeof(Index), cudaMemcpyDeviceToHost, stream),
          "looking for who left the box");
    check(cudaStreamSynchronize(stream), "looking for who left the box");
    return left;
  }

  Index running_sums(Index* values, Index count) const override {
    if (!space().device) return exec::running_sums(values, count);
    const auto stream = static_cast<cudaStream_t>(space().stream);
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, values, values, count + 1, stream), "adding up");
    check(cub::DeviceScan::ExclusiveSum(scratch_.of(bytes), bytes, values, values, count + 1, stream), "adding up");
    Index sum = 0;
    check(cudaMemcpyAsync(&sum, values + count, sizeof(Index), cudaMemcpyDeviceToHost, stream), "adding up");
    check(cudaStreamSynchronize(stream), "adding up");
    return sum;
  }

 private:
  mutable Room keys_, places_, scratch_, number_;
};

class OnCuda final : public exec::BackendHere {
 public:
  OnCuda(const exec::Space& space, std::string device, double* there, double* here)
      : BackendHere(space, there, here), device_(std::move(device)), cells_(space) {}

  [[nodiscard]] std::string device() const override { return device_; }
  [[nodiscard]] exec::Memory& memory() const override {
    if (!space().device) return exec::Memory::host();
    return memory_;
  }
  void finish() const override {
    if (!space().device) return;
    // What was wrong with a launch is told by the first, what went wrong in a kernel by the second.
    check(cudaGetLastError(), "a pass could not start");
    check(cudaStreamSynchronize(static_cast<cudaStream_t>(space().stream)), "a pass");
  }
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }

 private:
  std::string device_;
  mutable SharedMemory memory_;
  CudaCellLoops cells_;
};

CudaBackend on_host() { return {new OnCuda({}, "the host, for a test", nullptr, nullptr), {}}; }

/// The first device: CUDA_VISIBLE_DEVICES says which that is.
CudaBackend on_device() {
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status != cudaSuccess || devices == 0)
    return {nullptr, std::string("there is no CUDA device here (") +
                         (status == cudaSuccess ? "none was found" : cudaGetErrorString(status)) + ")"};
  cudaDeviceProp properties{};
  check(cudaGetDeviceProperties(&properties, 0), "asking for its properties");
  if (properties.major < 8)
    return {nullptr, std::string("the CUDA device ") + properties.name + " is of compute capability " +
                         std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                         "; 8.0 or higher is needed"};
  if (properties.concurrentManagedAccess == 0)
    return {nullptr, std::string("the CUDA device ") + properties.name +
                         " cannot share its memory with the host while it computes; Linux on bare metal can do so"};
  cudaStream_t stream = nullptr;
  check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "making a stream");
  double* there = nullptr;
  double* here = nullptr;
  check(cudaMalloc(&there, exec::Findings::size * sizeof(double)), "room for findings");
  check(cudaMallocHost(&here, exec::Findings::size * sizeof(double)), "room for findings");
  return {new OnCuda({stream, true}, properties.name, there, here), {}};
}

CudaBackend make() {
  const char* const on_host_wanted = std::getenv(cuda_on_host_variable);
  if (on_host_wanted != nullptr && std::strcmp(on_host_wanted, "1") == 0) return on_host();
  try {
    return on_device();
  } catch (const Error& error) {
    return {nullptr, error.what()};
  }
}

const CudaBackend* backend() {
  // Never destroyed: the device may be gone before everything that lies in its memory is.
  static const auto* const made = new CudaBackend(make());
  return made;
}

}  // namespace

}  // namespace mesogen

extern "C" MESOGEN_EXPORT const mesogen::CudaLibrary mesogen_cuda;
const mesogen::CudaLibrary mesogen_cuda{mesogen::cuda_library_magic, MESOGEN_CUDA_BUILD, &mesogen::backend};
