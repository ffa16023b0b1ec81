// The backend on a CUDA device. Its loops are those of the host, compiled by nvcc; what stands here is memory, order,
// and what can go wrong.

#include <cuda_runtime.h>

#include <cstdlib>
#include <cstring>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <limits>
#include <memory>
#include <string>

#include "backend/cuda/cuda_fetch.hpp"
#include "backend/cuda/cuda_mesh.hpp"
#include "backend/cuda_library.hpp"
#include "backend/host_loops.hpp"
#include "exec/emulated_memory.hpp"
#include "mesh/emulated_mesh.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/exec/cuda_check.hpp"

namespace mesogen {

namespace {

using exec::Access;
using exec::check_cuda;
using exec::check_launch;

/// Copies are part of the stream, so they come after all that it was asked for before.
class CudaMemory final : public exec::DeviceMemory {
 public:
  CudaMemory(const std::string& device, cudaStream_t stream)
      : DeviceMemory("the CUDA device " + device), stream_(stream) {}

  void to_device(void* device, const void* host, std::size_t bytes) override {
    check_cuda(cudaMemcpyAsync(device, host, bytes, cudaMemcpyHostToDevice, stream_), "a copy to the device");
    // From here on the host may write to its side again.
    check_cuda(cudaStreamSynchronize(stream_), "a copy to the device");
  }
  void to_host(void* host, const void* device, std::size_t bytes) override {
    check_cuda(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, stream_), "a copy to the host");
    check_cuda(cudaStreamSynchronize(stream_), "a copy to the host");
  }
  void copy(void* to, const void* from, std::size_t bytes) override {
    check_cuda(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, stream_), "a copy on the device");
  }
  void zero(void* device, std::size_t bytes) override {
    check_cuda(cudaMemsetAsync(device, 0, bytes, stream_), "zeroing an array");
  }
  [[nodiscard]] std::unique_ptr<exec::Fetch> make_fetch() override { return std::make_unique<CudaFetch>(stream_); }

 protected:
  [[nodiscard]] Room room() const override {
    Room room{};
    check_cuda(cudaMemGetInfo(&room.free, &room.total), "asking for its free memory");
    return room;
  }
  [[nodiscard]] void* take(std::size_t bytes) override {
    void* place = nullptr;
    const cudaError_t status = cudaMalloc(&place, bytes);
    if (status == cudaErrorMemoryAllocation) {
      (void)cudaGetLastError();
      return nullptr;
    }
    check_cuda(status, "taking memory");
    return place;
  }
  // It waits for all kernels, which may still use it.
  void give_back(void* place) noexcept override { (void)cudaFree(place); }

 private:
  cudaStream_t stream_;
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

using BlocksOfSearch = exec::ThreadBlocks<256>;

__global__ void note_outside(Box box, Index count, Index* found, Index* number) {
  const auto i = static_cast<Index>(BlocksOfSearch::thread(blockIdx.x, threadIdx.x));
  if (i >= 0 && i < count && !exec::is_inside(box.position, box.length, box.dimension, i))
    found[atomicAdd(number, 1)] = i;
}

class CudaCellLoops final : public exec::CellLoopsImpl {
 public:
  CudaCellLoops(const exec::Space& space, exec::Reductions& reductions, exec::DeviceMemory& memory)
      : CellLoopsImpl(space, reductions), keys_(&memory), places_(&memory), scratch_(&memory), number_(&memory) {}

  void order(const Index* cell, const std::int64_t* id, Index count, int cells, Index* order) const override {
    if (count == 0) return;
    const auto number = static_cast<std::size_t>(count);
    auto* const keys = room(keys_, 2 * number);
    auto* const places = room(places_, number);
    exec::for_each(space(), count, SortingKey{cell, id, keys, places}, "the keys of sorting");
    int bits = 32;
    while ((static_cast<std::int64_t>(cells) >> (bits - 32)) != 0) ++bits;
    std::size_t bytes = 0;
    check_cuda(
        cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, keys + number, places, order, count, 0, bits, stream()),
        "sorting");
    check_cuda(cub::DeviceRadixSort::SortPairs(room(scratch_, bytes), bytes, keys, keys + number, places, order, count,
                                               0, bits, stream()),
               "sorting");
  }

  Index find_outside(const double* const* position, const double* box, int dimension, Index count,
                     Index* found) const override {
    if (count == 0) return 0;
    constexpr const char* what = "looking for who left the box";
    auto* const number = room(number_, 1);
    check_cuda(cudaMemsetAsync(number, 0, sizeof(Index), stream()), what);
    const Box all{{position[0], position[1], position[2]}, {box[0], box[1], box[2]}, dimension};
    note_outside<<<BlocksOfSearch::number(count), BlocksOfSearch::size, 0, stream()>>>(all, count, found, number);
    check_launch(what);
    return to_host(number, what);
  }

  Index running_sums(Index* values, Index count) const override {
    std::size_t bytes = 0;
    // The last is not added to anything, but read.
    check_cuda(cudaMemsetAsync(values + count, 0, sizeof(Index), stream()), "adding up");
    check_cuda(cub::DeviceScan::ExclusiveSum(nullptr, bytes, values, values, count + 1, stream()), "adding up");
    check_cuda(cub::DeviceScan::ExclusiveSum(room(scratch_, bytes), bytes, values, values, count + 1, stream()),
               "adding up");
    return to_host(values + count, "adding up");
  }

 private:
  [[nodiscard]] cudaStream_t stream() const { return static_cast<cudaStream_t>(space().stream); }
  template <class T>
  [[nodiscard]] static T* room(exec::Array<T>& array, std::size_t size) {
    if (array.size() < size) array.resize_for_overwrite(size);
    return array.device(Access::write);
  }
  [[nodiscard]] Index to_host(const Index* number, const char* what) const {
    Index value = 0;
    check_cuda(cudaMemcpyAsync(&value, number, sizeof(Index), cudaMemcpyDeviceToHost, stream()), what);
    check_cuda(cudaStreamSynchronize(stream()), what);
    return value;
  }

  mutable exec::Array<std::uint64_t> keys_;
  mutable exec::Array<Index> places_;
  mutable exec::Array<std::byte> scratch_;
  mutable exec::Array<Index> number_;
};

class OnCuda final : public exec::BackendImpl {
 public:
  OnCuda(const exec::Space& space, const cudaDeviceProp& properties, double* on_device, double* pinned)
      : BackendImpl(space, on_device, pinned),
        device_(properties.name),
        architecture_("sm_" + std::to_string(10 * properties.major + properties.minor)),
        memory_(device_, static_cast<cudaStream_t>(space.stream)),
        cells_(space, reductions(), memory_),
        mesh_(space, memory_) {}

  [[nodiscard]] std::string device() const override { return device_; }
  [[nodiscard]] std::string architecture() const override { return architecture_; }
  [[nodiscard]] exec::DeviceMemory* memory() const override { return &memory_; }
  [[nodiscard]] bool has_host_code() const override { return false; }
  void finish() const override {
    check_cuda(cudaStreamSynchronize(static_cast<cudaStream_t>(space().stream)), "a wait for all of its work");
  }
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }
  [[nodiscard]] const mesh::DeviceMesh* mesh() const override { return &mesh_; }

 private:
  std::string device_;
  std::string architecture_;
  mutable CudaMemory memory_;
  CudaCellLoops cells_;
  CudaMesh mesh_;
};

/// The host plays the device: the same code, memory apart.
class OnHost final : public exec::BackendImpl {
 public:
  explicit OnHost(std::size_t bytes)
      : BackendImpl(exec::Space{}), memory_(bytes), cells_(reductions()), mesh_(memory_) {}

  [[nodiscard]] std::string device() const override { return "the host, for a test"; }
  [[nodiscard]] std::string architecture() const override { return "on the host"; }
  [[nodiscard]] exec::DeviceMemory* memory() const override { return &memory_; }
  [[nodiscard]] bool has_host_code() const override { return false; }
  void finish() const override {}
  [[nodiscard]] const exec::CellLoops& cells() const override { return cells_; }
  [[nodiscard]] const mesh::DeviceMesh* mesh() const override { return &mesh_; }

 private:
  mutable exec::EmulatedMemory memory_;
  exec::HostCellLoops cells_;
  mesh::EmulatedMesh mesh_;
};

CudaBackend on_host() {
  const char* const bytes = std::getenv(cuda_on_host_bytes_variable);
  return {new OnHost(bytes == nullptr ? std::numeric_limits<std::size_t>::max() : std::stoull(bytes)), {}};
}

/// The device that is current: without further ado the first that CUDA_VISIBLE_DEVICES lets be seen.
CudaBackend on_device() {
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status != cudaSuccess || devices == 0)
    return {nullptr, std::string("there is no CUDA device here (") +
                         (status == cudaSuccess ? "none was found" : cudaGetErrorString(status)) + ")"};
  int current = 0;
  cudaDeviceProp properties{};
  check_cuda(cudaGetDevice(&current), "asking which is current");
  check_cuda(cudaGetDeviceProperties(&properties, current), "asking for its properties");
  if (properties.major < 8)
    return {nullptr, std::string("the CUDA device ") + properties.name + " is of compute capability " +
                         std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                         "; 8.0 or higher is needed"};
  cudaStream_t stream = nullptr;
  check_cuda(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "making a stream");
  double* device = nullptr;
  double* pinned = nullptr;
  check_cuda(cudaMalloc(&device, exec::Reductions::size * sizeof(double)), "room for reductions");
  check_cuda(cudaMemsetAsync(device, 0, exec::Reductions::size * sizeof(double), stream), "room for reductions");
  check_cuda(cudaMallocHost(&pinned, exec::Reductions::size * sizeof(double)), "room for reductions");
  return {new OnCuda({stream, true}, properties, device, pinned), {}};
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
