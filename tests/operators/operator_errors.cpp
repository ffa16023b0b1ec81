// Errors of gradient and Laplacian on evenly and unevenly spread particles: a table in CSV. bench/operators.py makes
// docs/accuracy/operators.md of it.

#include "operator_errors.hpp"

#include <fmt/format.h>

#include <exception>
#include <string>
#include <utility>

#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

void print(const std::string& particles, int across, const Points& points) {
  for (const auto& [word, precision] :
       {std::pair{"double", Precision::double_precision}, std::pair{"single", Precision::single_precision}}) {
    for (const bool consistent : {false, true}) {
      for (int waves = across / 8; waves >= 1; waves /= 2) {
        const OperatorErrors errors = operator_errors(points, waves, {consistent, precision});
        fmt::print("{},{},{},{},{:.5g},{:.5g}\n", particles, word, consistent ? "consistent" : "plain", across / waves,
                   errors.gradient, errors.laplacian);
      }
    }
  }
}

}  // namespace

int main() {
  try {
    fmt::print("particles,precision,laplacian,points_per_wave,gradient_error,laplacian_error\n");
    print("lattice", 512, lattice(512, 512, 1.0 / 512));
    print("jitter 0.2 dx", 512, jittered(512, 512, 1.0 / 512, 0.2));
    print("after turbulence", 128, points_after_turbulence(128, 10000));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
