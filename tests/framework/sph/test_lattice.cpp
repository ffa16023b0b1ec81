#include "sph/lattice.hpp"

#include <gtest/gtest.h>

namespace {

using namespace mesogen;

sph::SmoothingKernel quintic(double h) {
  sph::SmoothingKernel kernel;
  kernel.shape = {{{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}}, 5};
  kernel.smoothing_length = h;
  kernel.scale = kernel.shape.normalisation(2) / (h * h);
  return kernel;
}

// Eigenvalues of the whole matrices for 16 x 16 particles, computed apart: 3.866 and 2.391 over h^2.
TEST(Lattice, KnowsHowFastTheShortestWavesAreTakenDown) {
  const double h = 4.0 / 3.0;
  EXPECT_NEAR(sph::largest_laplacian(quintic(h), 1.0, 2, false) * h * h, 3.866, 0.02);
  EXPECT_NEAR(sph::largest_laplacian(quintic(h), 1.0, 2, true) * h * h, 2.391, 0.001);
  // A length stretches everything with it.
  EXPECT_NEAR(sph::largest_laplacian(quintic(0.1 * h), 0.1, 2, true) * h * h, 239.1, 0.1);
}

TEST(Lattice, KnowsTheVolume) { EXPECT_NEAR(sph::volume_on_lattice(quintic(4.0 / 3.0), 1.0, 2), 1.0, 1e-3); }

}  // namespace
