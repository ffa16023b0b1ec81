#include "mesogen/plugin/context.hpp"

namespace mesogen {

PassContext::~PassContext() = default;

}  // namespace mesogen
