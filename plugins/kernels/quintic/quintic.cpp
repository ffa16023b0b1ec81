#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

/// Quintic spline, q = r / h (Schoenberg 1946; Morris, Fox & Zhu 1997, J. Comput. Phys. 136, 214):
///
///     f(q) = (3 - q)_+^5 - 6 (2 - q)_+^5 + 15 (1 - q)_+^5
///
/// Four continuous derivatives, support 3 h. Normalisation 7 / (478 pi h^2) in 2D, 1 / (120 pi h^3) in 3D.
class Quintic final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    return {.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}}, .power = 5};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(Quintic, "quintic", "1.0.0", "Quintic spline, support 3 h")
