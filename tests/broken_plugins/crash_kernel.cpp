// The cubic spline. See crash.hpp.
#include "crash.hpp"
#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

class Crashing final : public mesogen::Kernel {
 public:
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    crash::in("shape()");
    return {.pieces = {{2.0, {1.0}}, {1.0, {-4.0}}}, .power = 3};
  }
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(Crashing, "crashing", "1.0.0", "Crashes when it is told to")
