#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "backend/cuda_library.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/mesh/pass_spectrum.hpp"

/// Meshes beside the particles, in code that nvcc compiled: what a backend for CUDA offers them.
namespace mesogen::test {

/// Returns whether a pass that has no device is told so.
inline bool spectrum_asks_for_a_device() {
  mesh::Grid<2> grid;
  grid.length = {1.0, 1.0};
  grid.points = {8, 8};
  bool right = false;
  try {
    const mesh::PassSpectrum<2> spectrum(grid, nullptr);
  } catch (const std::logic_error& error) {
    right = std::string(error.what()).find("cannot work on the host") != std::string::npos;
  }
  std::printf("a mesh of a pass without a device: %s\n", right ? "refused" : "WRONG");
  return right;
}

inline bool sorts(const mesh::DeviceMesh& mesh, Index count, Index keys) {
  const auto size = static_cast<std::size_t>(count);
  std::vector<Index> key(size);
  for (Index i = 0; i < count; ++i)
    key[static_cast<std::size_t>(i)] = static_cast<Index>(exec::random_uniform(3, i, 0) * keys);
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), Index(0));
  const auto key_of = [&](Index i) { return key[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key_of(a) < key_of(b); });

  exec::Array<Index> keys_there(&mesh.memory()), sorted(&mesh.memory()), places(&mesh.memory());
  keys_there.assign(key);
  sorted.resize_for_overwrite(size);
  places.resize_for_overwrite(size);
  mesh.sort(keys_there.device(), count, keys, sorted.device(exec::Access::write), places.device(exec::Access::write));
  bool right = std::equal(order.begin(), order.end(), places.host().begin());
  for (std::size_t n = 0; n < size; ++n) right = right && sorted.host()[n] == key_of(order[n]);
  if (!right) std::printf("sorting %d by %d keys: WRONG\n", static_cast<int>(count), static_cast<int>(keys));
  return right;
}

/// The modes of a field, each by its definition.
template <int Dim>
std::vector<std::complex<double>> modes_of(const mesh::Grid<Dim>& grid, const double* field) {
  int points[3] = {1, 1, 1};
  std::copy(grid.points.begin(), grid.points.end(), points);
  // Turns per point; the first axis is the fastest.
  const auto part = [&](int axis, int mode, int at) {
    return mode * at % points[axis] / static_cast<double>(points[axis]);
  };
  std::vector<std::complex<double>> modes;
  for (int c = 0; c < points[2]; ++c)
    for (int b = 0; b < points[1]; ++b)
      for (int a = 0; a < grid.modes_in_row(); ++a) {
        std::complex<double> sum = 0.0;
        const double* value = field;
        for (int z = 0; z < points[2]; ++z)
          for (int y = 0; y < points[1]; ++y)
            for (int x = 0; x < points[0]; ++x)
              sum +=
                  *value++ * std::polar(1.0, -2.0 * std::numbers::pi * (part(0, a, x) + part(1, b, y) + part(2, c, z)));
        modes.push_back(sum);
      }
  return modes;
}

/// Several fields there and back.
template <class Real, int Dim>
bool transforms(mesh::DeviceTransform<Real>& transform, const mesh::DeviceMesh& mesh, const mesh::Grid<Dim>& grid,
                int fields) {
  const std::size_t points = grid.point_count();
  std::vector<Real> values;
  std::vector<std::complex<double>> expected;
  for (int field = 0; field < fields; ++field) {
    for (std::size_t n = 0; n < points; ++n)
      values.push_back(static_cast<Real>(exec::random_uniform(4, static_cast<std::int64_t>(n), field) - 0.5));
    const std::vector<double> own(values.end() - static_cast<std::ptrdiff_t>(points), values.end());
    const auto modes = modes_of(grid, own.data());
    expected.insert(expected.end(), modes.begin(), modes.end());
  }
  exec::Array<Real> there(&mesh.memory()), back(&mesh.memory());
  exec::Array<mesh::ComplexNumber<Real>> modes(&mesh.memory());
  there.assign(values);
  modes.resize_for_overwrite(expected.size());
  back.resize_for_overwrite(values.size());
  transform.forward(there.device(), modes.device(exec::Access::write), fields);
  double worst = 0.0;
  for (std::size_t n = 0; n < expected.size(); ++n) {
    const mesh::ComplexNumber<Real>& found = modes.host()[n];
    const std::complex<double> number(static_cast<double>(found.re), static_cast<double>(found.im));
    worst = std::max(worst, std::abs(number - expected[n]));
  }
  transform.backward(modes.device(exec::Access::read_write), back.device(exec::Access::write), fields);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double found = static_cast<double>(back.host()[n]) / static_cast<double>(points);
    worst = std::max(worst, std::abs(found - static_cast<double>(values[n])));
  }
  const bool right = worst <= (sizeof(Real) == 4 ? 1e-4 : 1e-12);
  if (!right)
    std::printf("%d fields of %zu points in %dD, %s, off by %.1e: WRONG\n", fields, points, Dim,
                sizeof(Real) == 4 ? "single" : "double", worst);
  return right;
}

template <class Real, int Dim>
bool transforms(const mesh::DeviceMesh& mesh, const std::array<int, Dim>& points) {
  mesh::Grid<Dim> grid;
  grid.points = points;
  grid.length.fill(1.0);
  const auto transform = mesh.transform<Real>(grid);
  // Plans for several numbers of fields share their room.
  bool right = true;
  for (const int fields : {3, 1, 3, 4}) right = transforms(*transform, mesh, grid, fields) && right;
  return right;
}

/// Of the device, or of the host in its place (MESOGEN_CUDA_ON_HOST = 1). Returns whether sorting and transforms are
/// right, or if there is neither.
inline bool meshes_are_right(bool device_there) {
  const CudaBackend cuda = cuda_backend();
  if (cuda.backend == nullptr) {
    if (device_there) std::printf("no backend: %s\n", cuda.problem.c_str());
    return !device_there;
  }
  const mesh::DeviceMesh& mesh = *cuda.backend->mesh();
  bool right = true;
  for (const auto& [count, keys] : {std::pair<Index, Index>{0, 4}, {1, 1}, {1000, 1}, {100'000, 1024}, {100'000, 9999}})
    right = sorts(mesh, count, keys) && right;
  // Edges that differ, so that no axis can stand for another.
  right = transforms<double, 2>(mesh, {8, 12}) && right;
  right = transforms<float, 2>(mesh, {12, 8}) && right;
  right = transforms<double, 3>(mesh, {6, 8, 10}) && right;
  right = transforms<float, 3>(mesh, {10, 6, 8}) && right;
  std::printf("sorting and Fourier transforms of %s: %s\n", cuda.backend->device().c_str(), right ? "right" : "WRONG");
  return right;
}

}  // namespace mesogen::test
