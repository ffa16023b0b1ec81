#include "run/smoothing.hpp"

#include <algorithm>
#include <cmath>

#include "text/rounded_text.hpp"

namespace mesogen {

sph::SmoothingKernel smoothing_of(const Case& source, sph::KernelShape shape) {
  sph::SmoothingKernel kernel;
  kernel.shape = std::move(shape);
  const double h = source.smoothing_length_ratio * source.particles.spacing;
  kernel.smoothing_length = h;
  double volume = h;
  for (int d = 1; d < source.dimension(); ++d) volume *= h;
  kernel.scale = kernel.shape.normalisation(source.dimension()) / volume;
  return kernel;
}

std::string range_problem(const Case& source, const sph::SmoothingKernel& kernel) {
  const bool single = source.run.precision == Precision::single_precision;
  // Neighbours far out have slopes some decades below the largest, which are to be there too.
  const double most = single ? 1e37 : 1e307;
  const double least = single ? 1e-30 : 1e-300;
  constexpr double q = 1e-3;
  const int dimension = source.dimension();
  const double slope = kernel.shape.normalisation(dimension) * std::abs(kernel.shape.derivative(q)) / q;  // of h = 1
  const double power = 1.0 / (dimension + 2);
  const double lowest = std::pow(slope / most, power) / source.smoothing_length_ratio;
  const double highest = std::pow(slope / least, power) / source.smoothing_length_ratio;
  const double spacing = source.particles.spacing;
  if (spacing >= lowest && spacing <= highest) return {};
  return "is beyond what the kernel's numbers can be in " + std::string(to_string(source.run.precision)) +
         " precision: spacings go from " + rounded_text(lowest) + " to " + rounded_text(highest) + " " +
         source.units.length + "; take " + (single ? "run.precision = \"double\", or " : "") + "another unit of length";
}

int shortest_axis(const Case& source) {
  const auto& size = source.domain.size;
  return static_cast<int>(std::ranges::min_element(size) - size.begin());
}

std::string support_problem(const Case& source, const sph::SmoothingKernel& kernel, bool walls) {
  if (source.domain.size.empty()) return {};
  const double most = source.domain.size[static_cast<std::size_t>(shortest_axis(source))] / 2.0;
  if (kernel.radius() <= most) return {};
  const std::string unit = " " + source.units.length;
  const double ratio = most / kernel.shape.support() / source.particles.spacing;
  return "the kernel's support of " + rounded_text(kernel.radius()) + unit + " is larger than half the box (" +
         rounded_text(most) + unit + "), so a particle would " +
         (walls ? "reach through both walls" : "meet its own image") + "; at most " +
         rounded_text(std::floor(ratio * 100.0) / 100.0) +
         " particle spacings here, or take a smaller particles.spacing";
}

}  // namespace mesogen
