#include "mesogen/plugin/kernel.hpp"

namespace mesogen {

Kernel::~Kernel() = default;

void Kernel::parameters(ParameterList&) {}

}  // namespace mesogen
