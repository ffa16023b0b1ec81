#include "sph/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
  constexpr int waves = 12;  // along each axis, up to that which changes sign from particle to particle
  std::array<double, std::size_t{2} * waves> cosine{};
  for (int n = 0; n < 2 * waves; ++n) cosine[static_cast<std::size_t>(n)] = std::cos(std::numbers::pi * n / waves);
  double largest = 0.0;
  for (int a = 0; a <= waves; ++a)
    for (int b = 0; b <= a; ++b)
      for (int c = 0; c <= (dimension == 3 ? b : 0); ++c) {
        double taken = 0.0;
        double norm = 0.0;
        for_each_neighbour(kernel, spacing, dimension, [&](int x, int y, int z, double r) {
          if (r == 0.0) return;
          const double slope = std::abs(kernel.shape.derivative(r / kernel.smoothing_length));
          const double weight = slope * (consistent ? r : 1.0 / r);
          const int phase = std::abs(a * x + b * y + c * z) % (2 * waves);
          taken += weight * (1.0 - cosine[static_cast<std::size_t>(phase)]);
          norm += weight * r * r;
        });
        largest = std::max(largest, 2.0 * dimension * taken / norm);
      }
  return largest;
}

double volume_on_lattice(const SmoothingKernel& kernel, double spacing, int dimension) {
  double sum = 0.0;
  for_each_neighbour(kernel, spacing, dimension, [&](int, int, int, double r) {
    sum += kernel.scale * kernel.shape.value(r / kernel.smoothing_length);
  });
  return 1.0 / sum;
}

}  // namespace mesogen::sph
