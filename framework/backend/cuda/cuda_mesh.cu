#include "backend/cuda/cuda_mesh.hpp"

#include <algorithm>
#include <cub/device/device_radix_sort.cuh>
#include <map>
#include <string>

#include "backend/cuda/cufft_library.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/cuda_check.hpp"

namespace mesogen {

namespace {

using exec::Access;
using exec::check_cuda;

void check_cufft(cufftResult status, const char* what) {
  if (status == CUFFT_SUCCESS) return;
  throw Error(ExitCode::run_failed, std::string("the CUDA device failed (") + what + "): error " +
                                        std::to_string(static_cast<int>(status)) + " of cuFFT");
}

/// cuFFT's calls in one precision.
template <class Real>
struct Cufft;

template <>
struct Cufft<float> {
  static constexpr cufftType forward = CUFFT_R2C, backward = CUFFT_C2R;
  static cufftResult execute(cufftHandle plan, const float* points, mesh::ComplexNumber<float>* modes) {
    return cufft().forward_single(plan, const_cast<float*>(points), reinterpret_cast<cufftComplex*>(modes));
  }
  static cufftResult execute(cufftHandle plan, mesh::ComplexNumber<float>* modes, float* points) {
    return cufft().backward_single(plan, reinterpret_cast<cufftComplex*>(modes), points);
  }
};

template <>
struct Cufft<double> {
  static constexpr cufftType forward = CUFFT_D2Z, backward = CUFFT_Z2D;
  static cufftResult execute(cufftHandle plan, const double* points, mesh::ComplexNumber<double>* modes) {
    return cufft().forward_double(plan, const_cast<double*>(points), reinterpret_cast<cufftDoubleComplex*>(modes));
  }
  static cufftResult execute(cufftHandle plan, mesh::ComplexNumber<double>* modes, double* points) {
    return cufft().backward_double(plan, reinterpret_cast<cufftDoubleComplex*>(modes), points);
  }
};

/// A plan transforms a fixed number of fields. Plans are made when they are first used; all work in the same room.
template <class Real>
class CudaTransform final : public mesh::DeviceTransform<Real> {
  using Fft = Cufft<Real>;

 public:
  CudaTransform(const std::array<int, 3>& points, int dimension, const exec::Space& space, exec::DeviceMemory& memory)
      : dimension_(dimension), stream_(static_cast<cudaStream_t>(space.stream)), room_(&memory) {
    std::reverse_copy(points.begin(), points.begin() + dimension, points_);  // cuFFT has the slowest axis first
  }
  ~CudaTransform() override {
    for (const auto& [kind, plan] : plans_) (void)cufft().destroy(plan);
  }

  void forward(const Real* points, mesh::ComplexNumber<Real>* modes, int fields) override {
    check_cufft(Fft::execute(plan(Fft::forward, fields), points, modes), "a Fourier transform");
  }
  void backward(mesh::ComplexNumber<Real>* modes, Real* points, int fields) override {
    check_cufft(Fft::execute(plan(Fft::backward, fields), modes, points), "a Fourier transform");
  }

 private:
  cufftHandle plan(cufftType type, int fields) {
    const auto found = plans_.find({type, fields});
    const cufftHandle plan = found == plans_.end() ? make(type, fields) : found->second;
    if (!room_.empty())
      check_cufft(cufft().set_work_area(plan, room_.device(Access::write)), "the room of a Fourier transform");
    return plan;
  }
  cufftHandle make(cufftType type, int fields) {
    constexpr const char* what = "planning a Fourier transform";
    cufftHandle plan = 0;
    std::size_t bytes = 0;
    check_cufft(cufft().create(&plan), what);
    plans_[{type, fields}] = plan;
    check_cufft(cufft().set_auto_allocation(plan, 0), what);
    check_cufft(cufft().make_plan_many(plan, dimension_, points_, nullptr, 1, 0, nullptr, 1, 0, type, fields, &bytes),
                what);
    check_cufft(cufft().set_stream(plan, stream_), what);
    if (room_.size() < bytes) room_.resize_for_overwrite(bytes);
    return plan;
  }

  int dimension_;
  int points_[3] = {1, 1, 1};
  cudaStream_t stream_;
  std::map<std::pair<cufftType, int>, cufftHandle> plans_;  // by kind and number of fields
  exec::Array<std::byte> room_;
};

struct Count {
  Index* place;
  MESOGEN_HOST_DEVICE void operator()(Index i) const { place[i] = i; }
};

template <class T>
T* room(exec::Array<T>& array, std::size_t size) {
  if (array.size() < size) array.resize_for_overwrite(size);
  return array.device(Access::write);
}

}  // namespace

void CudaMesh::sort(const Index* key, Index count, Index keys, Index* sorted, Index* order) const {
  if (count == 0) return;
  auto* const places = room(places_, static_cast<std::size_t>(count));
  exec::for_each(space_, count, Count{places}, "the places of sorting");
  int bits = 1;
  while ((keys >> bits) != 0) ++bits;
  const auto stream = static_cast<cudaStream_t>(space_.stream);
  const auto run = [&](void* scratch, std::size_t& bytes) {
    check_cuda(cub::DeviceRadixSort::SortPairs(scratch, bytes, key, sorted, places, order, count, 0, bits, stream),
               "sorting by cell of the mesh");
  };
  std::size_t bytes = 0;
  run(nullptr, bytes);
  run(room(scratch_, bytes), bytes);
}

std::unique_ptr<mesh::DeviceTransform<float>> CudaMesh::single_transform(const std::array<int, 3>& points,
                                                                         int dimension) const {
  return std::make_unique<CudaTransform<float>>(points, dimension, space_, memory_);
}
std::unique_ptr<mesh::DeviceTransform<double>> CudaMesh::double_transform(const std::array<int, 3>& points,
                                                                          int dimension) const {
  return std::make_unique<CudaTransform<double>>(points, dimension, space_, memory_);
}

}  // namespace mesogen
