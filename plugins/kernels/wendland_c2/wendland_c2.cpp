#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Wendland C2 of two and three dimensions, q = r / h (Wendland 1995; Dehnen & Aly 2012, MNRAS 425, 1068):
///
///     f(q) = (1 - q/2)_+^4 (1 + 2 q)
///
/// Two continuous derivatives, support 2 h. Normalisation 7 / (4 pi h^2) in 2D, 21 / (16 pi h^3) in 3D.
class WendlandC2 final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    // With t = 2 - q: f = t^4 (5 - 2 t) / 16.
    return {.pieces = {{2.0, {5.0 / 16.0, -2.0 / 16.0}}}, .power = 4};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(WendlandC2, "wendland_c2", "1.0.0", "Wendland C2, support 2 h")
