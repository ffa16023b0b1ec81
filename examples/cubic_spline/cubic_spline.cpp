#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Cubic spline, q = r / h (Monaghan & Lattanzio 1985, Astron. Astrophys. 149, 135):
///
///     f(q) = (2 - q)_+^3 - 4 (1 - q)_+^3
///
/// Support 2 h. Its second derivative is continuous but has kinks, which SPH's second derivatives feel: the quintic is
/// the better choice for active nematics; this one is here because so much was computed with it.
class CubicSpline final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    return {.pieces = {{2.0, {1.0}}, {1.0, {-4.0}}}, .power = 3};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(CubicSpline, "cubic_spline", "1.0.0", "Cubic spline, support 2 h")
