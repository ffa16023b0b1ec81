#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

Error::~Error() = default;

}  // namespace mesogen
