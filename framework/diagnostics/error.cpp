#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

Error::~Error() = default;

BadParameter::~BadParameter() = default;

}  // namespace mesogen
