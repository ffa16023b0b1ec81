#include "sph/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mesogen::sph {

namespace {

/// Calls action(x, y, z, r) for every neighbour within the support, itself included; x, y, z in spacings, r in m.
template <class Action>
void for_each_neighbour(const SmoothingKernel& kernel, double spacing, int dimension, Action&& action) {
  const int reach = static_cast<int>(kernel.radius() / spacing) + 1;
  const int across = dimension == 3 ? reach : 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -across; z <= across; ++z) action(x, y, z, spacing * std::sqrt(x * x + y * y + z * z));
}

}  // namespace

double largest_laplacian(const SmoothingKernel& kernel, double spacing, int dimension, bool consistent) {
  std::array<double, 3> taken{};  // by waves that change sign along one, two, three axes
  double norm = 0.0;
  for_each_neighbour(kernel, spacing, dimension, [&](int x, int y, int z, double r) {
    if (r == 0.0) return;
    const double slope = std::abs(kernel.shape.derivative(r / kernel.smoothing_length));
    const double weight = slope * (consistent ? r : 1.0 / r);
    norm += weight * r * r;
    const std::array<int, 3> along{x, x + y, x + y + z};
    for (int n = 0; n < dimension; ++n)
      if (along[static_cast<std::size_t>(n)] % 2 != 0) taken[static_cast<std::size_t>(n)] += 2.0 * weight;
  });
  return 2.0 * dimension * *std::max_element(taken.begin(), taken.end()) / norm;
}

double volume_on_lattice(const SmoothingKernel& kernel, double spacing, int dimension) {
  double sum = 0.0;
  for_each_neighbour(kernel, spacing, dimension, [&](int, int, int, double r) {
    sum += kernel.scale * kernel.shape.value(r / kernel.smoothing_length);
  });
  return 1.0 / sum;
}

}  // namespace mesogen::sph
