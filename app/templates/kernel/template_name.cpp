#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Quartic spline, q = r / h (Schoenberg 1946, Quart. Appl. Math. 4, 45):
///
///     f(q) = (2.5 - q)_+^4 - 5 (1.5 - q)_+^4 + 10 (0.5 - q)_+^4
///
/// Three continuous derivatives, support 2.5 h. Normalisation 96 / (1199 pi h^2) in 2D.
class TemplateNamePlugin final : public mesogen::Kernel {
 public:
  // Each piece: its knot, then the coefficients of (knot - q)_+^power, ^(power + 1), ... The framework normalises.
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    return {.pieces = {{2.5, {1.0}}, {1.5, {-5.0}}, {0.5, {10.0}}}, .power = 4};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Quartic spline, support 2.5 h")
