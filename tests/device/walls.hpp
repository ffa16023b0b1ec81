#pragma once

#include <cmath>
#include <cstdio>

#include "../framework/ghosts/walled_scene.hpp"
#include "backend/cuda_library.hpp"

/// Values at walls that the backend of the device finds.
namespace mesogen::test {

/// Are they those of the host, where particles start and after a sorting?
inline bool walls_are_right() {
  const CudaBackend device = cuda_backend();
  if (device.backend == nullptr) {
    std::printf("walls: %s\n", device.problem.c_str());
    return false;
  }
  for (const Precision precision : {Precision::double_precision, Precision::single_precision})
    for (const Sites& sites : {channel(), disc(false), disc(true)}) {
      const double tolerance = precision == Precision::double_precision ? 1e-11 : 1e-5;
      Walled on_host(sites, Continuation::ghosts, precision, Backend::host());
      Walled on_device(sites, Continuation::ghosts, precision, *device.backend);
      for (const double way : {0.0, 0.3}) {
        on_host.move(way * spacing);
        on_device.move(way * spacing);
        for (const auto& [name, kind] : kinds) {
          const std::vector<double> expected = on_host.at_walls(name);
          const std::vector<double> found = on_device.at_walls(name);
          for (std::size_t n = 0; n < expected.size(); ++n) {
            if (std::abs(found[n] - expected[n]) <= tolerance * largest(expected)) continue;
            std::printf("walls: %s, number %zu: %.15g on the device, %.15g on the host\n", name.c_str(), n, found[n],
                        expected[n]);
            return false;
          }
        }
      }
    }
  return true;
}

}  // namespace mesogen::test
