// The same functors on the host and on a CUDA device: pair sums of the framework and of wcsph over disordered particles
// in a wrapped box. Exits with 77 where there is no device (ctest: skipped), after the host results were checked
// against exact ones. Then what the backend of the device finds at walls; and what it offers a mesh, or with
// MESOGEN_CUDA_ON_HOST = 1 the host in its place.

#include <cuda_runtime.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "../../plugins/physics/wcsph/passes.hpp"
#include "ghosts/neighbourhood.hpp"
#include "meshes.hpp"
#include "reductions.hpp"
#include "sph/passes/derivatives.hpp"
#include "sph/passes/neighbour_runs.hpp"
#include "walls.hpp"

namespace {

using namespace mesogen;

constexpr int skipped = 77;

void check(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  std::printf("%s: %s\n", what, cudaGetErrorString(status));
  std::exit(1);
}

/// Memory on the host or on the device, filled from the host.
template <class T>
class Array {
 public:
  Array(const std::vector<T>& values, bool device) : device_(device), size_(values.size()) {
    if (device_) {
      check(cudaMalloc(&data_, size_ * sizeof(T)), "cudaMalloc");
      check(cudaMemcpy(data_, values.data(), size_ * sizeof(T), cudaMemcpyHostToDevice), "to the device");
    } else {
      host_ = values;
      data_ = host_.data();
    }
  }
  Array(const Array&) = delete;
  Array& operator=(const Array&) = delete;
  ~Array() {
    if (device_) cudaFree(data_);
  }
  T* data() { return data_; }
  std::vector<T> get() const {
    if (!device_) return host_;
    std::vector<T> values(size_);
    check(cudaMemcpy(values.data(), data_, size_ * sizeof(T), cudaMemcpyDeviceToHost), "from the device");
    return values;
  }

 private:
  bool device_;
  std::size_t size_;
  std::vector<T> host_;
  T* data_ = nullptr;
};

class Wrapped final : public Boundary {
 public:
  Continuation continuation(int) const override { return Continuation::wrapped; }
};

/// Quintic spline, h = 4/3 dx.
sph::SmoothingKernel quintic(double spacing) {
  sph::SmoothingKernel kernel;
  kernel.shape.power = 5;
  kernel.shape.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}};
  kernel.smoothing_length = spacing * 4.0 / 3.0;
  kernel.scale = 7.0 / (478.0 * std::numbers::pi) / (kernel.smoothing_length * kernel.smoothing_length);
  return kernel;
}

struct Result {
  std::vector<double> gradient, laplacian, acceleration;
  double milliseconds = 0.0;
};

template <class Real>
Result compute(int across, bool device) {
  Scene scene;
  scene.dimension = 2;
  scene.box = {1.0, 1.0, 0.0};
  scene.spacing = 1.0 / across;
  scene.precision = sizeof(Real) == 4 ? Precision::single_precision : Precision::double_precision;
  const sph::SmoothingKernel kernel = quintic(scene.spacing);
  scene.smoothing_length = kernel.smoothing_length;
  scene.support = 3.0 * kernel.smoothing_length;
  const int count = across * across;
  Particles particles;
  particles.dimension = 2;
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> jitter(-0.2 * scene.spacing, 0.2 * scene.spacing);
  std::vector<std::int64_t> id;
  std::array<std::vector<double>, 2> lattice;
  for (int i = 0; i < count; ++i) {
    id.push_back(i);
    lattice[0].push_back((i % across + 0.5) * scene.spacing + jitter(generator));
    lattice[1].push_back((i / across + 0.5) * scene.spacing + jitter(generator));
  }
  particles.id.assign(id);
  for (int d = 0; d < 2; ++d) {
    particles.position[d].assign(lattice[d]);
    particles.images[d].resize(id.size());
  }
  const Wrapped boundary;
  Neighbourhood neighbourhood(scene, boundary);
  (void)neighbourhood.sort(particles);
  const auto position = exec::pointers(particles.position, exec::Side::host);
  Neighbours<Real, 2> host{};
  neighbourhood.fill(host, exec::Side::host);
  const Real range = Real(neighbourhood.neighbour_range());
  std::vector<Index> first_run(static_cast<std::size_t>(count) + 1);
  exec::for_each({}, count, sph::FindRuns<Real, 2, false>{host, range * range, first_run.data(), nullptr});
  std::exclusive_scan(first_run.begin(), first_run.end(), first_run.begin(), 0);
  host.run_begin = first_run.data();
  std::vector<NeighbourRun> runs(static_cast<std::size_t>(first_run.back()));
  exec::for_each({}, count, sph::FindRuns<Real, 2, true>{host, range * range, nullptr, runs.data()});

  // Everything that the grid points to, where the passes run.
  const std::size_t stored = static_cast<std::size_t>(count) + 16;
  Array<Real> x({host.local[0], host.local[0] + stored}, device);
  Array<Real> y({host.local[1], host.local[1] + stored}, device);
  Array<Index> run_begin(first_run, device);
  Array<NeighbourRun> run_list(runs, device);
  Neighbours<Real, 2> grid = host;
  grid.local[0] = x.data();
  grid.local[1] = y.data();
  grid.run_begin = run_begin.data();
  grid.run = run_list.data();

  const double pi = std::numbers::pi;
  std::vector<Real> velocity(2 * stored, Real(0));
  std::vector<Real> pressure(stored, Real(0));
  for (int i = 0; i < count; ++i) {
    const double px = position[0][i];
    const double py = position[1][i];
    velocity[i] = Real(std::sin(2 * pi * px) * std::cos(2 * pi * py));
    velocity[stored + i] = Real(std::cos(2 * pi * px));
    pressure[i] = Real(std::sin(2 * pi * py));
  }
  const auto stride = static_cast<std::ptrdiff_t>(stored);
  const std::vector<Real> zero(stored, Real(0)), zeros(4 * stored, Real(0));
  Array<Real> u(velocity, device), p(pressure, device), volume(zero, device), gradient(zeros, device);
  Array<Real> laplacian(zeros, device), correction(zeros, device), acceleration(zeros, device);
  Array<Real> density(std::vector<Real>(stored, Real(1)), device);

  exec::Space space;
  space.device = device;
  cudaEvent_t start{}, stop{};
  if (device) {
    cudaEventCreate(&start);
    cudaEventCreate(&stop);
  }
  const auto run = [&] {
    // V = spacing^2 nearly: the passes under test take any volume.
    sph::Derivatives<Real, 2> wanted{};
    wanted.volume = {volume.data(), stride};
    wanted.count = 2;
    for (int c = 0; c < 2; ++c) {
      wanted.source[c] = u.data() + c * stride;
      for (int d = 0; d < 2; ++d) wanted.gradient[c][d] = gradient.data() + (2 * c + d) * stride;
      wanted.laplacian[c] = laplacian.data() + c * stride;
    }
    wanted.correction = {correction.data(), stride};
    sph::run_derivatives<Real, 2>(space, grid, kernel, wanted);
    wcsph::Momentum<Real, 2, false, wcsph::PressureForm::corrected> momentum{};
    momentum.volume = {volume.data(), stride};
    momentum.pressure = {p.data(), stride};
    momentum.density = {density.data(), stride};
    momentum.correction = {correction.data(), stride};
    momentum.acceleration = {acceleration.data(), stride};
    momentum.viscosity = Real(0.1);
    sph::pair_sum<Real, 2>(space, grid, kernel, momentum);
  };
  std::vector<Real> even(stored, Real(scene.spacing * scene.spacing));
  if (device) {
    check(cudaMemcpy(volume.data(), even.data(), stored * sizeof(Real), cudaMemcpyHostToDevice), "volumes");
    cudaEventRecord(start);
  } else {
    std::copy(even.begin(), even.end(), volume.data());
  }
  run();
  Result result;
  if (device) {
    cudaEventRecord(stop);
    check(cudaDeviceSynchronize(), "passes");
    float milliseconds = 0.0F;
    cudaEventElapsedTime(&milliseconds, start, stop);
    result.milliseconds = static_cast<double>(milliseconds);
  }
  const auto keep = [&](const Array<Real>& array, int components) {
    const std::vector<Real> all = array.get();
    std::vector<double> kept;
    for (int c = 0; c < components; ++c)
      for (int i = 0; i < count; ++i) kept.push_back(static_cast<double>(all[c * stored + i]));
    return kept;
  };
  result.gradient = keep(gradient, 4);
  result.laplacian = keep(laplacian, 2);
  result.acceleration = keep(acceleration, 2);
  if (!device) {
    // The host's gradients are right: a second-order operator on a wave of 2 pi.
    double worst = 0.0;
    for (int i = 0; i < count; ++i) {
      const double exact = 2 * pi * std::cos(2 * pi * position[0][i]) * std::cos(2 * pi * position[1][i]);
      worst = std::max(worst, std::abs(result.gradient[i] - exact));
    }
    std::printf("%d^2, %s: worst error of a gradient on the host %.2e of %.2f\n", across,
                sizeof(Real) == 4 ? "single" : "double", worst, 2 * pi);
    if (worst > 0.02 * 2 * pi) std::exit(1);
  }
  return result;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  double scale = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    scale = std::max(scale, std::abs(a[i]));
  }
  return largest / scale;
}

template <class Real>
bool agree(int across, bool device_there, double tolerance) {
  const Result host = compute<Real>(across, false);
  if (!device_there) return true;
  compute<Real>(across, true);  // loads the code
  const Result device = compute<Real>(across, true);
  const double worst =
      std::max({difference(host.gradient, device.gradient), difference(host.laplacian, device.laplacian),
                difference(host.acceleration, device.acceleration)});
  std::printf("  host against device %.1e (bound %.1e); both passes on the device %.3f ms\n", worst, tolerance,
              device.milliseconds);
  return worst <= tolerance;
}

}  // namespace

int main() {
  int devices = 0;
  const bool there = cudaGetDeviceCount(&devices) == cudaSuccess && devices > 0;
  if (!mesogen::test::spectrum_asks_for_a_device()) return 1;
  const bool good = agree<double>(64, there, 1e-11) && agree<float>(64, there, 1e-3) && agree<float>(500, there, 1e-2);
  if (!good || (there && !(mesogen::test::reductions_are_right() && mesogen::test::walls_are_right()))) return 1;
  if (!mesogen::test::meshes_are_right(there)) return 1;
  if (!there) std::printf("no CUDA device here: the device part was skipped\n");
  return there ? 0 : skipped;
}
