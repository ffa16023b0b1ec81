#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Wendland C6 of two and three dimensions, q = r / h (Wendland 1995; Dehnen & Aly 2012, MNRAS 425, 1068):
///
///     f(q) = (1 - q/2)_+^8 (1 + 4 q + 25/4 q^2 + 4 q^3)
///
/// Six continuous derivatives, support 2 h. Normalisation 39 / (14 pi h^2) in 2D, 1365 / (512 pi h^3) in 3D.
class WendlandC6 final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    // With t = 2 - q: f = t^8 (264 - 308 t + 121 t^2 - 16 t^3) / 1024.
    return {.pieces = {{2.0, {264.0 / 1024.0, -308.0 / 1024.0, 121.0 / 1024.0, -16.0 / 1024.0}}}, .power = 8};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(WendlandC6, "wendland_c6", "1.0.0", "Wendland C6, support 2 h")
