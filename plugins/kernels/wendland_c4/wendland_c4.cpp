#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Wendland C4 of two and three dimensions, q = r / h (Wendland 1995; Dehnen & Aly 2012, MNRAS 425, 1068):
///
///     f(q) = (1 - q/2)_+^6 (1 + 3 q + 35/12 q^2)
///
/// Four continuous derivatives, support 2 h. Normalisation 9 / (4 pi h^2) in 2D, 495 / (256 pi h^3) in 3D.
class WendlandC4 final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    // With t = 2 - q: f = t^6 (224 - 176 t + 35 t^2) / 768.
    return {.pieces = {{2.0, {224.0 / 768.0, -176.0 / 768.0, 35.0 / 768.0}}}, .power = 6};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(WendlandC4, "wendland_c4", "1.0.0", "Wendland C4, support 2 h")
