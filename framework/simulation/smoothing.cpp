#include "simulation/smoothing.hpp"

#include <cmath>

#include "simulation/rounded_text.hpp"

namespace mesogen {

sph::SmoothingKernel smoothing_of(const Case& source, sph::KernelShape shape) {
  sph::SmoothingKernel kernel;
  kernel.shape = std::move(shape);
  const double h = source.smoothing_length_ratio * source.particles.spacing;
  kernel.smoothing_length = h;
  kernel.scale = kernel.shape.normalisation(2) / (h * h);
  return kernel;
}

int shortest_axis(const Case& source) {
  const auto& size = source.domain.size;
  return size.size() == 2 && size[1] < size[0] ? 1 : 0;
}

std::string support_problem(const Case& source, const sph::SmoothingKernel& kernel, bool walls) {
  if (source.domain.size.size() != 2) return {};
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
