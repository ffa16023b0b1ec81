// Also with a descriptor and parameters that are wrong whatever the fault.

#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

class Unfit final : public mesogen::Kernel {
 public:
  void parameters(mesogen::ParameterList& list) override {
    list.text("fault", fault_).choices({"none", "rises", "narrow"});
    list.number("sharpness", sharpness_).above(0.0).doc("nothing");
  }
  [[nodiscard]] mesogen::sph::KernelShape shape() const override {
    if (fault_ == "rises") return {.pieces = {{2.0, {1.0}}, {1.0, {-9.0}}}, .power = 3};
    const double support = fault_ == "narrow" ? 1.0 : 2.0;
    return {.pieces = {{support, {1.0}}, {0.5 * support, {-4.0}}}, .power = 3};
  }

 private:
  std::string fault_ = "none";
  double sharpness_ = -1.0;
};

}  // namespace

MESOGEN_KERNEL_PLUGIN(Unfit, "unfit_kernel", "1.0", "")
