#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Cubic spline, q = r / h (Monaghan & Lattanzio 1985, Astron. Astrophys. 149, 135):
///
///     f(q) = (2 - q)_+^3 - 4 (1 - q)_+^3
///
/// Two continuous derivatives, support 2 h. Normalisation 5 / (14 pi h^2) in 2D.
class TemplateName final : public mesogen::Kernel {
 public:
  // Each piece: its knot, then the coefficients of (knot - q)_+^power, ^(power + 1), ... The framework normalises.
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    return {.pieces = {{2.0, {1.0}}, {1.0, {-4.0}}}, .power = 3};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(TemplateName, "template_name", "1.0.0", "Cubic spline, support 2 h")
